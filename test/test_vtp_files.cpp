// SPDX-License-Identifier: MIT

// VTP files: every form of them is read alike, and what is broken is refused. That VTK's own files are read,
// python/tests/test_files_read_by_tool.py shows.

#include "../examples/mesh_files.h"

#include "mesh_bytes.h"
#include "vtp_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace test_vtp_files {

namespace {

using namespace mesh_bytes;
using mesh_files::Polygon_soup;
using vtp_files::Data;
using vtp_files::Form;
using vtp_files::Packing;

/// The faces as rows of numbers of points.
Faces faces_of(const Polygon_soup& soup) {
  Faces faces;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) faces.emplace_back(soup.face(f).begin(), soup.face(f).end());
  return faces;
}

void expect_mesh(const std::string& content, const std::vector<Point>& points, const Faces& faces,
                 const std::string& name) {
  try {
    const Polygon_soup soup = mesh_files::mesh_of_content("m.vtp", content);
    EXPECT_EQ(soup.points, points) << name;
    EXPECT_EQ(faces_of(soup), faces) << name;
    EXPECT_TRUE(soup.remarks.empty()) << name;
  } catch (const mesh_files::Unreadable_file& error) {
    ADD_FAILURE() << name << ": " << error.what();
  }
}

void expect_refusal(const std::string& content, const std::string& message) {
  try {
    mesh_files::mesh_of_content("m.vtp", content);
    ADD_FAILURE() << "was read, without " << message;
  } catch (const mesh_files::Unreadable_file& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.compare(0, 6, "m.vtp:"), 0) << what;
    EXPECT_NE(what.find(message), std::string::npos) << what << "\ndoes not say " << message;
    EXPECT_TRUE(std::all_of(what.begin(), what.end(), [](char c) { return c >= ' ' && c <= '~'; })) << what;
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

std::string tetrahedron(const Form& form = {}) { return vtp_files::file(tetrahedron_points, tetrahedron_faces, form); }

/// A piece as text.
std::string piece(const std::string& points, std::size_t number_of_points, const std::string& polygons,
                  const std::string& polygon_ends, const std::string& strips = "", const std::string& strip_ends = "") {
  const auto numbers = [](const std::string& text) { return std::count(text.begin(), text.end(), ' '); };
  const auto array = [](const std::string& name, const std::string& values) {
    return "<DataArray type='Int32' Name='" + name + "'>" + values + "</DataArray>";
  };
  return "<Piece NumberOfPoints='" + std::to_string(number_of_points) + "' NumberOfPolys='" +
         std::to_string(numbers(polygon_ends)) + "' NumberOfStrips='" + std::to_string(numbers(strip_ends)) +
         "'><Points><DataArray type='Float32' NumberOfComponents='3'>" + points + "</DataArray></Points><Polys>" +
         array("offsets", polygon_ends) + array("connectivity", polygons) + "</Polys><Strips>" +
         array("connectivity", strips) + array("offsets", strip_ends) + "</Strips></Piece>";
}

std::string file_of(const std::string& pieces) {
  return "<VTKFile type='PolyData'><PolyData>" + pieces + "</PolyData></VTKFile>";
}

}  // namespace

TEST(Vtp_files, AreTheSameInAllTheirForms) {
  for (const Form& form : vtp_files::all_forms())
    expect_mesh(tetrahedron(form), tetrahedron_points, tetrahedron_faces, form.name());
}

TEST(Vtp_files, MayHaveNumbersOfAnyType) {
  for (const Data data : {Data::text, Data::base64, Data::appended})
    for (const char* type : {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"}) {
      Form form;
      form.data = data;
      form.order = Order::big;
      form.corner = type;
      expect_mesh(tetrahedron(form), tetrahedron_points, tetrahedron_faces, form.name());
    }
}

TEST(Vtp_files, AreKnownByTheirFirstTagWhateverTheirName) {
  for (const char* before : {"", "\xef\xbb\xbf", "\n \t\r\n"})
    EXPECT_EQ(mesh_files::mesh_of_content("mesh.obj", before + tetrahedron()).number_of_faces(), 4U);
  expect_refusal("# vtk DataFile Version 3.0\n", "a VTP file starts with <VTKFile>, this one does not");
  expect_refusal("<?xml version='1.0'?><COLLADA/>", "a VTP file starts with <VTKFile>");
}

TEST(Vtp_files, HaveThePolygonsOfAllPiecesAndThenTheirStrips) {
  const std::string file =
      file_of(piece("0 0 0 1 0 0 1 1 0 0 1 0 2 2 2", 5, "4 0 1 2 3 0 2 3", "0 5 8 ", "0 1 3 2 4", "5 ") +
              piece("", 0, "", "") + piece("9 0 0\n9 1 0\t9 0 1", 3, "2 1 0", "3 ", "0 1 2 1 1 0 0", "3 7 "));
  expect_mesh(file, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 2}, {9, 0, 0}, {9, 1, 0}, {9, 0, 1}},
              {{}, {4, 0, 1, 2, 3}, {0, 2, 3}, {7, 6, 5}, {0, 1, 3}, {3, 1, 2}, {3, 2, 4}, {5, 6, 7}}, "pieces");
}

TEST(Vtp_files, OfTheToolAreReadAgain) {
  Polygon_soup soup;
  soup.points = {{0.1, 0, 0}, {1. / 3, 0, 0}, {1, 1, 0}, {0, 1, 1e-300}};
  soup.corners = {0, 1, 2, 3, 0, 2, 3};
  soup.first_corner = {0, 4, 7};
  const std::vector<std::size_t> labels = {7, 2};
  const std::map<std::size_t, mesh_files::Color> colors = {{2, {1, 2, 3}}, {7, {4, 5, 6}}};
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / (std::to_string(std::random_device()()) + ".vtp");
  mesh_files::Output_file file(path.string());
  mesh_files::write_vtp(file, {soup, labels, colors});
  file.commit();
  expect_mesh(mesh_files::read_content(path.string()), soup.points, faces_of(soup), "written");
  std::filesystem::remove(path);
}

TEST(Vtp_files, OfOtherKindsAreRefusedByTheirNames) {
  const std::string file = tetrahedron();
  expect_refusal(replaced(file, "PolyData", "PPolyData"), "only names those with the pieces");
  expect_refusal(replaced(file, "PolyData", "UnstructuredGrid"), "holds 'UnstructuredGrid', not 'PolyData'");
  expect_refusal(replaced(file, "LittleEndian", "MiddleEndian"), ":3: the order of bytes is 'MiddleEndian'");
  Form form;
  form.data = Data::base64;
  form.packing = Packing::stored;
  form.has_wide_headers = true;
  for (const char* name : {"LZ4", "LZMA"})
    expect_refusal(replaced(tetrahedron(form), "vtkZLib", std::string("vtk") + name),
                   "is compressed by 'vtk" + std::string(name) + "DataCompressor', which is not read");
  expect_refusal(replaced(tetrahedron(form), "UInt64", "UInt16"), "the type of headers is 'UInt16'");
  form.data = Data::appended;
  expect_refusal(replaced(tetrahedron(form), "\"raw\"", "\"hex\""), "the appended data are encoded as 'hex'");
}

TEST(Vtp_files, BrokenOnesAreRefused) {
  const std::string points = "0 0 0 1 0 0 0 1 0";
  const auto refuse = [&](const std::string& piece, const std::string& message) {
    expect_refusal(file_of(piece), message);
  };
  refuse(piece(points, 3, "0 1 3", "3 "), "the array 'connectivity' names point 3, the piece has 3");
  refuse(piece(points, 3, "0 1 -1", "3 "), "names point -1");
  refuse(piece(points, 3, "0 1 x", "3 "), "the array 'connectivity' has 'x', not a whole number");
  refuse(piece(points, 3, "0 1 2", "4 "), "the array 'offsets' has 4 behind 0, where there are 3 corners");
  refuse(piece(points, 3, "0 1 2", "2 1 "), "the array 'offsets' has 1 behind 2");
  refuse(piece(points, 3, "0 1 2", "-1 "), "the array 'offsets' has -1 behind 0");
  refuse(piece(points, 4, "0 1 2", "3 "), "the array 'Points' has 9 coordinates, the piece promises 4 points");
  refuse(piece(points + " 0", 3, "0 1 2", "3 "), "the array 'Points' has 10 coordinates");
  refuse(piece("0 0 0 1 0 0 0 1 nan", 3, "0 1 2", "3 "), "has a coordinate that is not finite");
  refuse(piece("0 0 0 1 0 0 0 1 0x", 3, "0 1 2", "3 "), "the array 'Points' has '0x', not a number");
  const std::string whole = piece(points, 3, "0 1 2", "3 ");
  refuse(replaced(whole, "NumberOfPolys='1'", "NumberOfPolys='2'"), "has 1 numbers, the piece promises 2 Polys");
  refuse(replaced(whole, "NumberOfPolys='1'", "NumberOfPolys='18446744073709551615'"), "the piece promises 1844674407");
  refuse(replaced(whole, "NumberOfPolys='1'", "NumberOfPolys='-1'"), "NumberOfPolys is '-1'");
  refuse(replaced(whole, "'offsets'", "'others'"), "Polys of the piece have no offsets");
  refuse(replaced(whole, "<Points>", "<Point>"), "the piece has no points");
  refuse(replaced(whole, "Components='3'", "Components='2'"), "has points that are not of three coordinates");
  refuse(replaced(whole, "</Points>", "</Points"), "the tag 'Points' is broken");
  refuse(replaced(whole, "Name='offsets'", "Name=offsets"), "the tag 'DataArray' is broken");
  refuse(replaced(whole, "<Polys>", "< Polys>"), "a tag has no name");
  expect_refusal("<VTKFile type='PolyData'><PolyData>\n" + whole, ":2: the file ends without </VTKFile>");
  expect_refusal("<VTKFile type='PolyData'><!-- ", "the file ends within a comment");
  expect_refusal("<VTKFile type='PolyData'>" + std::string(300000, '<'), "a tag has no name");
}

TEST(Vtp_files, BrokenBytesAreRefused) {
  Form form;
  form.data = Data::appended;
  const std::string file = tetrahedron(form), size_of_points = bytes<std::uint32_t>({48});
  expect_refusal(replaced(file, size_of_points, bytes<std::uint32_t>({4000000000})),
                 "the array 'Points' is broken or cut off: 4000000000 bytes should follow");
  expect_refusal(replaced(file, size_of_points, bytes<std::uint32_t>({47})), "has 47 bytes, which are no whole number");
  expect_refusal(replaced(file, "\"Float32\"", "\"Bit\""), "the array 'Points' has numbers of the type 'Bit'");
  expect_refusal(replaced(file, "\"Float32\"", "\"Float64\""), "the array 'Points' has 6 coordinates");
  expect_refusal(replaced(file, "offset=\"24\"", "offset=\"99999\""), "the array 'Points' begins behind the end");
  expect_refusal(replaced(file, "\n  _", "\n  "), "the appended data do not begin with \"_\"");
  form.corner = "Float32";
  expect_refusal(tetrahedron(form), "the array 'offsets' has numbers of the type 'Float32'");
  form = {};
  form.data = Data::base64;
  expect_refusal(replaced(tetrahedron(form), vtp_files::base64(size_of_points).substr(0, 4), "****"),
                 "the array 'Points' is broken or cut off");
}

TEST(Vtp_files, BrokenBlocksAreRefused) {
  Form form;
  form.data = Data::appended;
  form.packing = Packing::stored;
  const std::string file = tetrahedron(form), header = bytes<std::uint32_t>({2, 40, 8});
  const auto with_header = [&](std::uint32_t blocks, std::uint32_t size, std::uint32_t size_of_last) {
    return replaced(file, header, bytes<std::uint32_t>({blocks, size, size_of_last}));
  };
  expect_refusal(with_header(4000000000, 40, 8), "the array 'Points' promises 4000000000 blocks");
  const std::string broken = "the array 'Points' has a compressed block that is broken";
  expect_refusal(with_header(2, 4000000000, 8), broken);
  expect_refusal(with_header(2, 41, 8), broken);
  expect_refusal(with_header(2, 39, 8), broken);
  expect_refusal(with_header(2, 40, 0), broken);
  const std::string mark = "\x78\1\1";
  const std::size_t block = file.find(mark, file.find(header));
  for (const std::size_t byte : {0U, 1U, 2U, 3U, 5U, 20U, 45U, 48U}) {  // marks, sizes, numbers and the sum of them
    std::string damaged = file;
    damaged[block + byte] = static_cast<char>(damaged[block + byte] ^ 4);
    expect_refusal(damaged, broken);
  }
}

TEST(Vtp_files, SmallOnesDoNotBecomeLargeByWhatTheyShare) {
  std::string pieces;
  for (int i = 0; i < 20; ++i)
    pieces +=
        "<Piece NumberOfPoints='4'><Points><DataArray type='Float32' NumberOfComponents='3' format='appended' "
        "offset='0'/></Points></Piece>";
  expect_refusal("<VTKFile type='PolyData'>" + pieces + "<AppendedData encoding='raw'>_" + bytes<std::uint32_t>({48}) +
                     std::string(48, '\0') + "</AppendedData></VTKFile>",
                 "the array 'Points' shares its data with others");
}

TEST(Vtp_files, ElementsWithinElementsAreNoDanger) {
  std::string nested = "<VTKFile type='PolyData'>";
  for (int i = 0; i < 100000; ++i) nested += "<a>";
  expect_refusal(nested, "the file ends without </VTKFile>");
  const std::size_t key = tetrahedron().find("<InformationKey", tetrahedron().find("<Points>"));
  expect_refusal(tetrahedron().insert(key, nested), ":17: the file ends within a DataArray");
}

TEST(Vtp_files, CutOnesAreRefused) {
  for (const Form& form : vtp_files::all_forms()) {
    const std::string file = tetrahedron(form);
    for (std::size_t size = 0; size < file.size() / 2; size += 61)
      EXPECT_THROW(mesh_files::mesh_of_content("m.vtp", file.substr(0, size)), mesh_files::Unreadable_file)
          << form.name() << " cut to " << size;
  }
}

TEST(Vtp_files, DamagedOnesAreReadSoundlyOrRefused) {
  std::mt19937 random(1);
  std::size_t refused = 0, runs = 0;
  for (const Form& form : vtp_files::all_forms()) {
    const std::string file = tetrahedron(form);
    for (int round = 0; round < 20; ++round, ++runs) {
      std::string damaged = file;
      for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
      try {
        const Polygon_soup soup = mesh_files::mesh_of_content("m.vtp", damaged);
        for (const auto corner : soup.corners) EXPECT_LT(corner, soup.points.size());
        EXPECT_EQ(soup.first_corner.back(), soup.corners.size());
      } catch (const mesh_files::Unreadable_file& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, runs / 10);
  EXPECT_LT(refused, runs);
}

}  // namespace test_vtp_files
