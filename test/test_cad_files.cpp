// SPDX-License-Identifier: MIT

// CAD files of the command-line tool segment_mesh, as texts. That other programs read them,
// python/tests/test_files_of_tool.py shows; what is in them, test_boundary_representation.cpp.

#include <gtest/gtest.h>

#ifndef SEGMENT_MESH

TEST(Cad_files, AreWritten) { GTEST_SKIP() << "the tool is not built"; }

#else

#include "segment_mesh_tool.h"
#include "solids.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace test_cad_files {

namespace {

using namespace segment_mesh_tool;
using nlohmann::json;

/// Runs the tool in a folder of its own.
class Cad_files : public Segment_mesh_tool {
 protected:
  void write_solid(const std::string& name, const solids::Solid& solid,
                   const solids::Point& stretch = {1, 1, 1}) const {
    std::ostringstream off;
    off.precision(17);
    off << "OFF\n" << solid.points.size() << " " << solid.faces.size() << " 0\n";
    for (const solids::Point& p : solid.points) off << p.cwiseProduct(stretch).transpose() << "\n";
    for (const auto& f : solid.faces) off << "3 " << f[0] << " " << f[1] << " " << f[2] << "\n";
    write(name, off.str());
  }
};

std::size_t number_of(const std::string& words, const std::string& text) {
  std::size_t number = 0;
  for (std::size_t at = 0; (at = text.find(words, at)) != std::string::npos; at += words.size()) ++number;
  return number;
}

}  // namespace

#ifdef SEGMENT_MESH_WITH_OPEN_CASCADE

TEST_F(Cad_files, HaveFacesOnTheSurfacesOfTheSegments) {
  write_solid("shaft.off", solids::stepped_shaft(solids::even(0.15)));
  const Result result = run({"shaft.off", "--engineering", "-o", "shaft.step", "-o", "shaft.igs", "-o", "shaft.brep",
                             "-o", "shaft.ply", "--report", "shaft.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("for millimetres; --unit tells others"), std::string::npos);
  const auto written = files();
  const json cad = json::parse(written.at("shaft.json"))["cad"];
  EXPECT_EQ(cad["defect"], "");
  EXPECT_EQ(cad["triangles"], 0);
  EXPECT_EQ(cad["solids"], 1);
  std::map<std::string, std::size_t> types;
  double area = 0;
  for (const json& face : cad["faces"]) {
    ++types[face["type"].get<std::string>()];
    area += face["area"].get<double>();
  }
  EXPECT_NEAR(area, cad["area"].get<double>(), 1e-9);

  const std::string& step = written.at("shaft.step");
  EXPECT_EQ(number_of("MANIFOLD_SOLID_BREP", step), 1U);
  EXPECT_EQ(number_of("ADVANCED_FACE('segment_", step), cad["faces"].size());
  EXPECT_EQ(number_of("= PLANE(", step), types["plane"]);
  EXPECT_EQ(number_of("= CYLINDRICAL_SURFACE(", step), types["cylinder"]);
  EXPECT_EQ(number_of("= CONICAL_SURFACE(", step), types["cone"]);
  EXPECT_EQ(number_of("= TOROIDAL_SURFACE(", step), types["torus"]);
  EXPECT_NE(step.find("PRODUCT('shaft'"), std::string::npos);
  EXPECT_GE(number_of("COLOUR_RGB", step), 2U);
  EXPECT_NE(step.find("SI_UNIT(.MILLI.,.METRE.)"), std::string::npos);
  EXPECT_NE(step.find("END-ISO-10303-21;"), std::string::npos);
  EXPECT_EQ(written.at("shaft.brep").compare(0, 10, "\nCASCADE T"), 0) << written.at("shaft.brep").substr(0, 40);
  EXPECT_NE(written.at("shaft.igs").find("T0000001"), std::string::npos);
}

TEST_F(Cad_files, KeepTheCoordinatesAndNameTheirUnit) {
  write_solid("box.off", solids::box(solids::by_kernel()));
  const Result result = run({"box.off", "--engineering", "--unit", "inch", "-o", "box.step", "--report", "box.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors.find("--unit"), std::string::npos);
  const auto written = files();
  EXPECT_NE(written.at("box.step").find("'INCH'"), std::string::npos);
  EXPECT_NE(written.at("box.step").find("CARTESIAN_POINT('',(-1.,-1.5,-0.5))"), std::string::npos);
  const json cad = json::parse(written.at("box.json"))["cad"];
  EXPECT_EQ(cad["unit"], "inch");
  EXPECT_NEAR(cad["volume"].get<double>(), 6 * std::pow(25.4, 3), 1e-6);
}

TEST_F(Cad_files, ThatAreNotRightAreWrittenOnlyWhereTheyAreWanted) {
  // Thinner than what the kernel takes for one point.
  write_solid("foil.off", solids::box(solids::by_kernel()), {1, 1, 1e-8});
  write_solid("box.off", solids::box(solids::by_kernel()));
  Result result = run({"foil.off", "--engineering", "-o", "foil.step", "--report", "foil.json"});
  EXPECT_EQ(result.exit_code, 8);
  EXPECT_NE(result.errors.find("nothing was written: it is not closed"), std::string::npos) << result.errors;
  EXPECT_EQ(files().size(), 2U);

  result = run({"foil.off", "--engineering", "-o", "foil.step", "--report", "foil.json", "--keep-invalid"});
  EXPECT_EQ(result.exit_code, 8);
  EXPECT_NE(result.errors.find("the CAD file is not right: it is not closed"), std::string::npos) << result.errors;
  EXPECT_EQ(json::parse(files().at("foil.json"))["cad"]["closed"], false);
  EXPECT_NE(files().at("foil.step").find("END-ISO-10303-21;"), std::string::npos);

  result = run({"foil.off", "box.off", "--engineering", "-o", "cad_%.step"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_EQ(files().count("cad_foil.step"), 0U);
  EXPECT_EQ(files().count("cad_box.step"), 1U);
}

TEST_F(Cad_files, AreRefusedWhereNoSurfacesAreFound) {
  write_solid("box.off", solids::box(solids::by_kernel()));
  expect_failure(1, "give --engineering, too", {"box.off", "-o", "box.step"});
  expect_failure(1, "give --output part.step, too", {"box.off", "--engineering", "--unit", "mm"});
  expect_failure(1, "give --output part.step, too", {"box.off", "--engineering", "--keep-invalid"});
  expect_failure(1, "mile is none of mm, cm, m, inch, ft",
                 {"box.off", "--engineering", "-o", "b.step", "--unit", "mile"});
}

TEST_F(Cad_files, AreRefusedBeforeTheWorkWhereTheirLibraryIsMissing) {
  write_solid("box.off", solids::box(solids::by_kernel()));
  std::filesystem::create_directory(path("away_from_the_library"));
  program_ = path("away_from_the_library/segment_mesh");
  std::filesystem::copy_file(SEGMENT_MESH, program_);
  expect_failure(1, "CAD files need a library that cannot be loaded: segment_mesh_cad",
                 {"box.off", "--engineering", "-o", "box.step"});
  EXPECT_EQ(run({"box.off", "--engineering", "-o", "box.ply"}).exit_code, 0);
}

#else

TEST_F(Cad_files, AreRefusedInOneSentenceWithoutOpenCascade) {
  write_solid("box.off", solids::box(solids::by_kernel()));
  expect_failure(1, "CAD files need Open CASCADE", {"box.off", "--engineering", "-o", "box.step"});
  EXPECT_NE(run({"--help"}).output.find("Open CASCADE"), std::string::npos);
}

#endif

}  // namespace test_cad_files

#endif
