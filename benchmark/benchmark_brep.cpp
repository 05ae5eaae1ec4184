// SPDX-License-Identifier: MIT

// Boundary representations for CAD systems: how many are valid and closed, how many keep triangles, how close their areas
// and volumes are to the truth, how far they are from the mesh, how large their STEP files are, and the time beside that
// of the segmentation.

#include "../examples/segment_mesh/Cad_shape.h"
#include "../test/solids.h"
#include "measurement.h"

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace RW_segmentation;
using namespace measurement;
using Json = nlohmann::ordered_json;
using Kernel_point = Mesh::Point;

struct Subject {
  std::string name;
  Mesh mesh;
  double area = std::numeric_limits<double>::quiet_NaN();  // of the CAD's faces; not a number where it is not known
};

/// Vertices where the surface touches itself are doubled.
Mesh mesh_of(std::vector<Kernel_point> points, std::vector<std::vector<std::size_t>> faces) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  if (!PMP::is_polygon_soup_a_polygon_mesh(faces)) PMP::orient_polygon_soup(points, faces);
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

std::vector<Subject> constructed_solids() {
  std::vector<Subject> subjects;
  for (const auto& [name, meshing] : {std::pair(".even", solids::even(0.1)), {".kernel", solids::by_kernel()}})
    for (const solids::Solid& solid : solids::all(meshing)) {
      std::vector<Kernel_point> points;
      for (const solids::Point& p : solid.points) points.emplace_back(p.x(), p.y(), p.z());
      subjects.push_back({solid.name + name, mesh_of(std::move(points), solid.faces)});
    }
  return subjects;
}

/// NAME_5k.off beside NAME.json, which has the area of the CAD's faces.
std::vector<Subject> solids_in_folder(const std::filesystem::path& folder, const std::string& suffix) {
  std::vector<Subject> subjects;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json") continue;
    std::vector<Kernel_point> points;
    std::vector<std::vector<std::size_t>> faces;
    if (!CGAL::IO::read_polygon_soup((folder / (name + suffix + ".off")).string(), points, faces)) continue;
    const Json truth = Json::parse(std::ifstream(entry.path()));
    subjects.push_back({name + suffix, mesh_of(std::move(points), std::move(faces)), truth["area"].get<double>()});
  }
  std::sort(subjects.begin(), subjects.end(), [](const Subject& a, const Subject& b) { return a.name < b.name; });
  return subjects;
}

struct Score {
  bool is_sound = false, has_triangles = true;
  double area_error = std::numeric_limits<double>::infinity(), volume_error = area_error;
  double distance = 0;  // of the faces to the mesh, at most, of its diagonal
  double megabytes = 0, segmentation_ms = 0, representation_ms = 0;
};

/// The name of a solid, what became of it, and what was refused on the way.
void print(const std::string& name, const Score& score, const Json& report) {
  std::map<std::string, std::size_t> types;
  for (const Json& face : report["faces"]) ++types[face["type"].get<std::string>()];
  std::printf("%-44s %-8s %8.1e %8.1e %8.1e %7.2f %8.0f %8.0f %6zu", name.c_str(), score.is_sound ? "sound" : "UNSOUND",
              score.area_error, score.volume_error, score.distance, score.megabytes, score.segmentation_ms,
              score.representation_ms, report["triangles"].get<std::size_t>());
  for (const auto& [type, number] : types) std::printf(" %zu %s", number, type.c_str());
  if (!score.is_sound) std::printf("; %s", report["defect"].get<std::string>().c_str());
  for (const auto& [reason, number] : report["refusals"].items())
    std::printf("; refused: %zu, %s", number.get<std::size_t>(), reason.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

Score score_of(const Subject& subject) {
  Score score;
  std::vector<std::size_t> ids(num_faces(subject.mesh));
  const auto map = boost::make_iterator_property_map(ids.begin(), get(boost::face_index, subject.mesh));
  const Dual_mesh_of<Mesh> dual(subject.mesh);
  const Stopwatch segmentation;
  const std::size_t segments = segmentation_into_surfaces<CGAL::Sequential_tag>(dual, map);
  const std::vector<Analytic_surface> surfaces = segment_surfaces(dual, map, segments);
  score.segmentation_ms = segmentation.milliseconds();

  const Stopwatch representation;
  const std::unique_ptr<const segment_mesh::Cad_shape> shape(
      segment_mesh_new_cad_shape(dual, dual.read_segments(map), surfaces, segment_mesh::length_units[0], {}));
  score.representation_ms = representation.milliseconds();
  const Json report = shape->report();
  score.is_sound = shape->defect().empty();
  score.has_triangles = report["triangles"].get<std::size_t>() > 0;
  const auto error = [&](double truth, const char* name) {
    return std::abs(report[name].get<double>() - truth) / truth;
  };
  score.area_error = error(subject.area, "area");
  score.volume_error = error(report["mesh_volume"].get<double>(), "volume");
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(subject.mesh);
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  for (const Json& face : report["faces"])
    score.distance = std::max(score.distance, face["distance_to_mesh"].get<double>() / diagonal);
  const std::vector<mesh_files::Color> colors(segments, mesh_files::Color{200, 200, 200});
  score.megabytes = double(shape->content(segment_mesh::Cad_format::step, subject.name, colors).size()) / 1e6;
  print(subject.name, score, report);
  return score;
}

void print_result(const std::string& set, const std::vector<Score>& scores) {
  std::size_t sound = 0, without_triangles = 0, exact = 0;
  std::vector<double> areas, volumes, distances, megabytes;
  double segmentation = 0, representation = 0;
  for (const Score& s : scores) {
    constexpr double exact_area = 1e-4;  // of the CAD's
    sound += s.is_sound;
    without_triangles += s.is_sound && !s.has_triangles;
    exact += s.area_error <= exact_area;
    if (!std::isnan(s.area_error)) areas.push_back(s.area_error);
    volumes.push_back(s.volume_error);
    distances.push_back(s.distance);
    megabytes.push_back(s.megabytes);
    segmentation += s.segmentation_ms;
    representation += s.representation_ms;
  }
  std::printf("RESULT bench=brep set=%s solids=%zu sound=%zu without_triangles=%zu exact_area=%zu", set.c_str(),
              scores.size(), sound, without_triangles, exact);
  if (!areas.empty()) std::printf(" median_area_error=%.2g max_area_error=%.2g", median(areas), maximum(areas));
  std::printf(" median_volume_error=%.2g max_volume_error=%.2g median_distance=%.2g max_distance=%.2g", median(volumes),
              maximum(volumes), median(distances), maximum(distances));
  std::printf(" median_mb=%.2f ms=%.0f segmentation_ms=%.0f\n", median(megabytes), representation, segmentation);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How well boundary representations of segmented solids come out.");
  std::string data;
  std::vector<std::string> suffixes = {"_5k", "_30k", "_t"};
  app.add_option("--data", data,
                 "A folder of NAME_5k.off and so on, with NAME.json, which has \"area\"; otherwise\n"
                 "constructed solids")
      ->check(CLI::ExistingDirectory);
  app.add_option("--suffixes", suffixes, "What follows NAME")->delimiter(',')->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  try {
    if (data.empty()) suffixes = {""};
    for (const std::string& suffix : suffixes) {
      std::printf("\n%-44s %-8s %8s %8s %8s %7s %8s %8s %6s faces\n", ("solids" + suffix).c_str(), "", "area", "volume",
                  "distance", "MB", "segm. ms", "ms", "triang");
      std::vector<Score> scores;
      for (const Subject& subject : data.empty() ? constructed_solids() : solids_in_folder(data, suffix))
        scores.push_back(score_of(subject));
      if (!scores.empty()) print_result(data.empty() ? "constructed" : "cad" + suffix, scores);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_brep: %s\n", error.what());
    return 1;
  }
}
