// SPDX-License-Identifier: MIT

// Dialects of mesh files: what programs of the world write beside what the formats say.

#include "../examples/mesh_files.h"

#include "dialects.h"
#include "gmsh_and_medit_files.h"
#include "large_shapes.h"
#include "mesh_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_mesh_dialects {

namespace {

using namespace mesh_bytes;
using mesh_files::Polygon_soup;
using Triangle = std::array<Point, 3>;

const std::string byte_order_mark = "\xef\xbb\xbf";

/// The triangles by their corners' places, each from its lowest corner on.
std::vector<Triangle> triangles_of(const Polygon_soup& soup) {
  std::vector<Triangle> result;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto face = soup.face(f);
    EXPECT_EQ(face.size(), 3);
    Triangle triangle = {soup.points[face[0]], soup.points[face[1]], soup.points[face[2]]};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    result.push_back(triangle);
  }
  return result;
}

std::vector<Triangle> tetrahedron() {
  Polygon_soup soup;
  soup.points = tetrahedron_points;
  for (const auto& face : tetrahedron_faces) {
    for (const std::size_t corner : face) soup.corners.push_back(static_cast<Polygon_soup::Index>(corner));
    soup.end_face();
  }
  return triangles_of(soup);
}

struct File {
  std::string name, content, remark = "";
};

void expect_tetrahedron(const File& file) {
  try {
    const Polygon_soup soup = mesh_files::mesh_of_content(file.name, file.content);
    EXPECT_EQ(soup.points.size(), 4U) << file.name;
    EXPECT_EQ(triangles_of(soup), tetrahedron()) << file.name;
    ASSERT_EQ(soup.remarks.size(), file.remark.empty() ? 0U : 1U) << file.name;
    if (!file.remark.empty()) {
      EXPECT_NE(soup.remarks[0].find(file.remark), std::string::npos) << soup.remarks[0];
    }
  } catch (const mesh_files::Unreadable_file& error) {
    ADD_FAILURE() << error.what();
  }
}

void expect_refusal(const std::string& name, const std::string& content, const std::string& message) {
  try {
    mesh_files::mesh_of_content(name, content);
    ADD_FAILURE() << name << " was read";
  } catch (const mesh_files::Unreadable_file& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.compare(0, name.size(), name), 0) << what;
    EXPECT_NE(what.find(message), std::string::npos) << what << "\ndoes not say " << message;
    EXPECT_TRUE(std::all_of(what.begin(), what.end(), [](char c) { return c >= ' ' && c <= '~'; })) << what;
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

const std::string off_points = "0 0 0\n1 0 0\n0 1 0\n0 0 0.5\n", off_faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string off = "OFF\n4 4 6\n" + off_points + off_faces;
const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string ply_vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply_faces = "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply = "ply\nformat ascii 1.0\n" + ply_vertices + ply_faces + off_points + off_faces;

/// The data of a binary PLY file: floats and, for each face, a byte and whole numbers.
template <class Index>
std::string ply_data(Order order = Order::little) {
  std::string data;
  for (const Point& p : tetrahedron_points)
    for (int i = 0; i < 3; ++i) data += bytes({static_cast<float>(p[i])}, order);
  for (const auto& f : tetrahedron_faces)
    data += "\3" + bytes<Index>({static_cast<Index>(f[0]), static_cast<Index>(f[1]), static_cast<Index>(f[2])}, order);
  return data;
}

std::string text_stl(const std::string& name = "t", bool is_ended = true) {
  std::ostringstream file;
  file << "solid " << name << "\n";
  for (const auto& f : tetrahedron_faces) {
    file << "facet normal 0 0 1\n outer loop\n";
    for (const std::size_t v : f) file << "  vertex " << tetrahedron_points[v] << "\n";
    file << " endloop\nendfacet\n";
  }
  if (is_ended) file << "endsolid " << name << "\n";
  return file.str();
}

std::string binary_stl(const std::string& header, std::uint32_t count = 4) {
  std::string file = header;
  file.resize(80, ' ');
  file += bytes({count});
  for (const auto& f : tetrahedron_faces) {
    file += std::string(12, '\0');
    for (const std::size_t v : f)
      for (int i = 0; i < 3; ++i) file += bytes({static_cast<float>(tetrahedron_points[v][i])});
    file += std::string(2, '\0');
  }
  return file;
}

}  // namespace

TEST(Mesh_dialects, MarksAndBlanksAtTheBeginningArePassedOver) {
  for (const std::string& before : {byte_order_mark, byte_order_mark + "\r\n", std::string("\n \t\n  ")})
    for (const auto& [name, content] :
         {std::pair<std::string, std::string>("t.off", off), {"t.obj", obj}, {"t.ply", ply}, {"t.stl", text_stl()}})
      expect_tetrahedron({name, before + content});
  expect_tetrahedron({"indented.obj", "  " + replaced(obj, "\n", "\n\t ")});
  expect_tetrahedron({"binary.ply", byte_order_mark + "ply\nformat binary_little_endian 1.0\n" + ply_vertices +
                                        ply_faces + ply_data<std::int32_t>()});
}

TEST(Mesh_dialects, LinesMayEndInAnyWay) {
  for (const std::string& end : {std::string("\r"), std::string("\r\n"), std::string("\n\r\n")})
    for (const auto& [name, content] :
         {std::pair<std::string, std::string>("t.off", off), {"t.obj", obj}, {"t.ply", ply}, {"t.stl", text_stl()}})
      expect_tetrahedron({name, replaced(content, "\n", end)});
  // Two programs wrote at this file.
  expect_tetrahedron({"mixed.obj", obj.substr(0, 16) + replaced(obj.substr(16), "\n", "\r")});
}

TEST(Mesh_dialects, HeadersOfBinaryPlyFilesEndWithCarriageReturns) {
  for (const Order order : {Order::little, Order::big}) {
    const std::string header = "ply\nformat binary_" + std::string(order == Order::little ? "little" : "big") +
                               "_endian 1.0\n" + ply_vertices + ply_faces;
    for (const std::string& end : {std::string("\r"), std::string("\n"), std::string("\r\n")})
      expect_tetrahedron({"rhino.ply", replaced(header, "\n", end) + ply_data<std::int32_t>(order)});
  }
  // The data begin with a byte that is a line feed.
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement vertex 10\rproperty char x\rproperty char y\r"
      "property char z\relement face 0\rproperty list uchar int vertex_indices\rend_header\r";
  EXPECT_EQ(mesh_files::mesh_of_content("feed.ply", header + std::string(30, '\n')).points.at(9), Point(10, 10, 10));
}

TEST(Mesh_dialects, ObjFacesOfTheFirstYears) { expect_tetrahedron({"fo.obj", replaced(obj, "f ", "fo ")}); }

TEST(Mesh_dialects, PlyHeadersMaySayMore) {
  expect_tetrahedron({"signed.ply", replaced(ply, "format", "Created by a program, 2003\nformat")});
  expect_tetrahedron({"late.ply", replaced(ply, "end_header", "obj_info 7\nwritten at night\nend_header")});
}

TEST(Mesh_dialects, PlyNumbersOf64Bits) {
  const std::string header = "ply\nformat binary_little_endian 1.0\n" + ply_vertices;
  const auto faces = [](const std::string& type) { return replaced(ply_faces, "uchar int", "uchar " + type); };
  for (const char* type : {"int64", "long"})
    expect_tetrahedron({type + std::string(".ply"), header + faces(type) + ply_data<std::int64_t>()});
  for (const char* type : {"uint64", "ulong"})
    expect_tetrahedron({type + std::string(".ply"), header + faces(type) + ply_data<std::uint64_t>()});
  std::string far = header + faces("uint64") + ply_data<std::uint64_t>();
  far.back() = '\x80';
  expect_refusal("far.ply", far, "a corner of the face is 922337203685477");
}

TEST(Mesh_dialects, PlyStripsOfTriangles) {
  const auto file = [](const std::string& strips) {
    return "ply\nformat ascii 1.0\n" + ply_vertices + "element tristrips 1\nproperty list int int vertex_indices\n" +
           "end_header\n" + off_points + strips;
  };
  // The second triangle of a strip is turned; -1 ends one; a corner twice leads on.
  expect_tetrahedron({"two.ply", file("13 0 2 1 -1 0 1 3 2 -1 2 0 3 -1\n"), ""});
  expect_tetrahedron({"joined.ply", file("21 0 2 1 1 0 0 0 1 3 3 1 1 1 2 3 3 2 2 2 0 3\n")});
  expect_refusal("far.ply", file("3 0 1 4\n"), "the face names vertex 4, the file has 4");
  expect_refusal("negative.ply", file("3 0 1 -2\n"), "a corner of the face is -2");
}

TEST(Mesh_dialects, TextStlInAnyLayout) {
  const std::string line = replaced(text_stl(), "\n", " ");
  for (const File& file :
       {File{"one_line.stl", line}, File{"one_line_of_windows.stl", line + "\r\n"},
        File{"no_name.stl", replaced(line, "solid t", "solid")},
        File{"word_a_line.stl", replaced(text_stl(), " outer loop", "outer\nloop")},
        File{"named.stl", text_stl("facet of a vertex")},
        File{"named_on_one_line.stl", replaced(text_stl("a vertex"), "\n", " ")},
        File{"capitals.stl", replaced(replaced(text_stl(), "vertex", "VERTEX"), "solid", "SOLID")},
        File{"blanks.stl", "   " + text_stl()},
        File{"two.stl", text_stl().substr(0, text_stl().find("facet n", 30)) + "endsolid\nsolid 2\n" +
                            text_stl().substr(text_stl().find("facet n", 30))},
        File{"headless.stl", text_stl().substr(8)}, File{"latin.stl", text_stl("b\xe4r")},
        File{"endless.stl", text_stl("t", false), "ends without \"endsolid\""}})
    expect_tetrahedron(file);
  const std::string endless = text_stl("t", false);
  expect_refusal("cut.stl", endless.substr(0, endless.size() - 10), "the file ends here");
}

TEST(Mesh_dialects, BinaryStlThatBeginsLikeTextOrIsNotQuiteAsLongAsItSays) {
  for (const char* header : {"solid", "SCAN", "  solid made of bytes\n facet"}) {
    const std::string file = binary_stl(header);
    expect_tetrahedron({"exact.stl", file});
    expect_tetrahedron({"long.stl", file + "x", "passed over 1 byte"});
    expect_tetrahedron({"longer.stl", file + std::string(70, '\0'), "passed over 70 bytes"});
    expect_tetrahedron({"short.stl", file.substr(0, file.size() - 1), "the last facet lacks 1 "});
    expect_tetrahedron({"shorter.stl", file.substr(0, file.size() - 2), "the last facet lacks 2 "});
    expect_refusal("cut.stl", file.substr(0, file.size() - 3), "the header promises 4 facets, which take 284 bytes");
    expect_tetrahedron({"uncounted.stl", binary_stl(header, 0), "counts no facets, but 4 follow"});
    expect_refusal("uncounted.stl", binary_stl(header, 0) + "x", "the header counts no facets, but 201 bytes follow");
  }
}

TEST(Mesh_dialects, OffInAnyLayout) {
  const std::string body = "4 4 6\n" + off_points + off_faces;
  for (const std::string& content :
       {replaced(off, "\n", " "), "OFF4 4 6\n" + off_points + off_faces, "off\n" + body, "coff\n" + body, body,
        replaced(body, "\n", " "), "OFF 4\n4\n6\n" + off_points + off_faces, "nOFF\n3\n" + body, "nOFF 3 " + body,
        "4OFF\n4 4 6\n0 0 0 1\n2 0 0 2\n0 0.5 0 0.5\n0 0 0.5 1\n" + off_faces,
        "OFF\n4 4 6\n" + off_points + replaced(off_faces, "3 ", "3\n").replace(0, 2, "3 "),
        "OFF\n4 4 6\n" + off_points + "3 0 2\n1\n3\n0 1\n3\n3 1 2 3\n3 2 0 3\n",
        "OFF\n4 4 6\n" + off_points + replaced(off_faces, "\n", " "),
        "OFF\n4 4 6\n" + replaced(off_points, "\n", "\t") + "\n" + off_faces,
        "OFF\n4 4 0\n" + replaced(off_points, "\n", " 1 0 0\n") + replaced(off_faces, "\n", " 255 0 0\n")})
    expect_tetrahedron({"t.off", content});
  for (const std::string& content : {off, "OFF4 4 6\n" + off_points + off_faces, "off\n" + body})
    expect_tetrahedron({"no_extension", content});
  expect_refusal("n.off", "nOFF\n4\n" + body, "the mesh has 4 dimensions");
  expect_refusal("4.off", "4OFF\n1 0 0\n1 0 0 0\n", ":3: a vertex at infinity");
  // A corner too few is not made up for by the number of corners of the next face.
  expect_refusal("few.off", replaced(off, "3 0 1 3", "3 0 1"), ":8: a corner of the face is missing");
}

TEST(Mesh_dialects, ObjIsKnownByItsFirstWordWhereNoNameTells) {
  expect_tetrahedron({"no_extension", "# by hand\n" + obj});
  EXPECT_EQ(mesh_files::mesh_of_content("-", "usemap x\n" + obj, mesh_files::Format::obj).points.size(), 4U);
  expect_refusal("-", "usemap x\n" + obj, "this is no OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file");
}

TEST(Mesh_dialects, GmshAndMeditInAllTheirForms) {
  for (const auto& [name, content] : gmsh_and_medit_files::all(tetrahedron_points, tetrahedron_faces)) {
    expect_tetrahedron({name, content});
    expect_tetrahedron({"no_extension", content});
    if (name.find("text") != std::string::npos)
      for (const char* line_end : {"\r\n", "\r"})
        expect_tetrahedron({name, byte_order_mark + replaced(content, "\n", line_end)});
  }
}

TEST(Mesh_dialects, GmshAndMeditHaveQuadsInOrder) {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 2, 0}};
  const Faces faces = {{3, 2, 4}, {0, 1, 2, 3}};
  for (const std::string& content :
       {gmsh_and_medit_files::msh_2_text(points, faces), gmsh_and_medit_files::msh_4_text(points, faces),
        gmsh_and_medit_files::msh_2_binary(points, faces, Order::little),
        gmsh_and_medit_files::msh_4_binary(points, faces, Order::big),
        gmsh_and_medit_files::medit_text(points, faces)}) {
    const Polygon_soup soup = mesh_files::mesh_of_content("m", content);
    EXPECT_EQ(soup.points, points);
    EXPECT_EQ(soup.corners, (std::vector<Polygon_soup::Index>{3, 2, 4, 0, 1, 2, 3}));
    EXPECT_EQ(soup.first_corner, (std::vector<std::size_t>{0, 3, 7}));
  }
}

TEST(Mesh_dialects, VolumesAndCurvedFacesOfGmshAndMeditAreRemarkedOn) {
  const std::string begin =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 0.5\n"
      "5 0.5 0 0\n6 0.5 0.5 0\n$EndNodes\n$Elements\n";
  const auto remark = [](const std::string& content) {
    const Polygon_soup soup = mesh_files::mesh_of_content("m", content);
    EXPECT_EQ(soup.corners, (std::vector<Polygon_soup::Index>{0, 1, 2}));
    return soup.remarks.size() == 1 ? soup.remarks[0] : "none or several";
  };
  EXPECT_EQ(remark(begin + "2\n1 4 2 0 1 1 2 3 4\n2 2 0 1 2 3\n$EndElements\n"), "passed over 1 element of volume");
  EXPECT_EQ(remark(begin + "1\n1 9 0 1 2 3 5 6 4\n$EndElements\n"),
            "1 curved face was read as a flat one between its corners");
  const std::string medit =
      "MeshVersionFormatted 1 Dimension 3 Vertices 4 0 0 0 1 1 0 0 1 0 1 0 1 0 0 .5 1 Tetrahedra 1 1 2 3 4 1";
  EXPECT_EQ(remark(medit + " Triangles 1 1 2 3 0 End"), "passed over 1 element of volume");
  std::string on_one_line = "MeshVersionFormatted 1 Dimension 3 Vertices 60";
  for (int i = 0; i < 60; ++i) on_one_line += " " + std::to_string(i) + " 0 " + std::to_string(i % 2) + " 0";
  EXPECT_EQ(mesh_files::mesh_of_content("t.mesh", on_one_line + " Triangles 1 1 2 3 0 End").points.size(), 60U);
  expect_refusal("t.mesh", medit + " End", "1 element of volume and no surface");
  expect_refusal("t.msh", begin + "1\n1 4 2 0 1 1 2 3 4\n$EndElements\n", "1 element of volume and no surface");
}

TEST(Mesh_dialects, BrokenGmshAndMeditFilesAreRefused) {
  using namespace gmsh_and_medit_files;
  const std::string msh_2 = msh_2_text(tetrahedron_points, tetrahedron_faces),
                    msh_4 = msh_4_text(tetrahedron_points, tetrahedron_faces),
                    medit = medit_text(tetrahedron_points, tetrahedron_faces);
  expect_refusal("4.0.msh", replaced(msh_4, "4.1 0 8", "4 0 8"),
                 ":2: the version is '4', and only 2.2 and 4.1 are read");
  expect_refusal("node.msh", replaced(msh_2, "16 0 0 0.5\n", "16 0 0\n"), "a coordinate is '");
  expect_refusal("no_node.msh", replaced(msh_2, "\n10 1 0 0\n", "\n11 1 0 0\n"), "names node 10, which is not there");
  expect_refusal("type.msh", replaced(msh_2, "2 2 2 0 1", "2 77 2 0 1"), "elements of type 77");
  expect_refusal("many.msh", replaced(msh_2, "$Nodes\n4", "$Nodes\n4000000000"), "promises 4000000000 nodes");
  expect_refusal("many_4.msh", replaced(msh_4, "2 1 0 3\n", "2 1 0 3000000000\n"), "promises 3000000000 nodes");
  expect_refusal("more.msh", replaced(msh_2, "$Nodes\n4", "$Nodes\n3"), "more in the section than it says");
  expect_refusal("infinite.msh", replaced(msh_2, " 0.5\n", " inf\n"), "a coordinate is not finite");
  expect_refusal("end.msh", replaced(msh_2, "$EndPhysicalNames\n", ""), "without $EndPhysicalNames");
  expect_refusal("word.mesh", replaced(medit, "Vertices # all of them\n4", "Vertices\nfour"), "a count is 'four'");
  expect_refusal("many.mesh", replaced(medit, "them\n4", "them\n4000000000"), "promises 4000000000 vertices");
  expect_refusal("zero.mesh", replaced(medit, "1 3 2 5", "0 3 2 5"), "the face names vertex 0");
  expect_refusal("five.mesh", replaced(medit, "1 3 2 5", "1 3 5 5"), "a face names vertex 5, the file has 4");
  expect_refusal("other.mesh", "OgreMesh",
                 ":1: a Medit file starts with MeshVersionFormatted, this one with 'OgreMesh'");
  for (const auto& [name, content] : all(tetrahedron_points, tetrahedron_faces))
    for (std::size_t size = 0; size < content.size() / 2; ++size)
      EXPECT_THROW(mesh_files::mesh_of_content(name, content.substr(0, size)).first_corner.at(1), std::exception)
          << name << " cut to " << size;
}

TEST(Mesh_dialects, WhatIsNoMeshIsCalledByItsName) {
  std::string utf16, big_utf16;
  for (const char c : obj) {
    utf16 += {c, '\0'};
    big_utf16 += {'\0', c};
  }
  for (const char* extension : {".off", ".obj", ".ply", ".stl", ""}) {
    const std::string name = std::string("t") + extension;
    expect_refusal(name, "\xff\xfe" + utf16, "this is text in UTF-16");
    expect_refusal(name, "\xfe\xff" + big_utf16, "this is text in UTF-16");
    expect_refusal(name, utf16, "this is text in UTF-16");
    expect_refusal(name, "\n<!DOCTYPE html>\n<html>", "this is a page of the web");
    expect_refusal(name, "<HTML><body>404", "this is a page of the web");
    expect_refusal(name, "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n", "Git LFS");
    expect_refusal(name, "PK\3\4" + std::string(50, '\1'), "ZIP archive");
    expect_refusal(name, "PK\3\4 models3D/part.off", "ZIP archive");
    expect_refusal(name, "PK\3\4 3D/3dmodel.model", "the ZIP archive is cut off");
  }
  expect_refusal("cut.3mf", "PK\3\4 [Content_Types].xml", "the ZIP archive is cut off");
  expect_refusal("text.stl",
                 "This is a text of more than eighty-four bytes, whose letters are no number of facets at all.\n",
                 ":1: an STL text starts with \"solid\", this one with 'This'");
}

#ifdef RW_SEGMENTATION_WITH_ZLIB

using dialects::packed;

TEST(Mesh_dialects, GzipIsKnownByItsFirstBytes) {
  for (const auto& [name, content] : {std::pair<std::string, std::string>("t.off.gz", off),
                                      {"t.obj.gz", obj},
                                      {"t.obj", obj},
                                      {"no_extension", ply},
                                      {"t.stl.gz", binary_stl("solid")}})
    expect_tetrahedron({name, packed(content)});
  expect_tetrahedron({"parts.off", packed(off.substr(0, 20)) + packed(off.substr(20))});
  expect_tetrahedron({"padded.off", packed(off) + std::string(512, '\0')});
  const std::string large = packed("OFF 4 4 6" + std::string(1000000, ' ') + "\n" + off_points + off_faces);
  expect_tetrahedron({"large.off", large});
  expect_refusal("cut.off", large.substr(0, large.size() / 2), "the gzip file is cut off");
  expect_refusal("broken.off", replaced(packed(off), packed(off).substr(10, 8), "brrroken"), "the gzip file is broken");
}

#endif

TEST(Mesh_dialects, AFileOnDiskIsReadLikeItsContent) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / (std::to_string(std::random_device()()) + ".obj");
  std::ofstream(path, std::ios::binary) << byte_order_mark << obj;
  EXPECT_EQ(triangles_of(mesh_files::read_mesh(path.string())), tetrahedron());
  std::filesystem::remove(path);
}

namespace {

/// The points, the corners and the remarks of a file, or why it is refused.
template <class Read>
std::string outcome_of(const Read& read) {
  std::ostringstream outcome;
  outcome.precision(17);
  try {
    const Polygon_soup soup = read();
    for (const auto& p : soup.points) outcome << p << ", ";
    for (const auto corner : soup.corners) outcome << corner << ' ';
    for (const auto first : soup.first_corner) outcome << first << ' ';
    for (const std::string& remark : soup.remarks) outcome << remark;
  } catch (const mesh_files::Unreadable_file& error) {
    outcome << error.what();
  }
  return outcome.str();
}

/// Some polygons of 3 to 6 corners over many points, as the body of a PLY file.
std::string binary_ply_of_polygons(std::size_t points, std::size_t faces, bool has_high_byte_first,
                                   const std::string& type_of_size, Polygon_soup& soup) {
  std::string ply = std::string("ply\nformat binary_") + (has_high_byte_first ? "big" : "little") +
                    "_endian 1.0\nelement vertex " + std::to_string(points) +
                    "\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(faces) + "\nproperty uchar flag\nproperty list " + type_of_size +
                    " int vertex_indices\nproperty short group\nend_header\n";
  const auto add = [&](auto value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    if (has_high_byte_first) std::reverse(bytes.begin(), bytes.end());
    ply.append(bytes.data(), bytes.size());
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  for (std::size_t i = 0; i < points; ++i) {
    const std::array<float, 3> p = {coordinate(random), coordinate(random), coordinate(random)};
    add(p[0]);
    add(std::uint8_t(7));
    add(p[1]);
    add(p[2]);
    soup.points.emplace_back(p[0], p[1], p[2]);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const std::uint32_t corners = 3 + random() % 4;
    add(std::uint8_t(1));
    if (type_of_size == "uchar")
      add(static_cast<std::uint8_t>(corners));
    else
      add(corners);
    for (std::uint32_t i = 0; i < corners; ++i) {
      soup.corners.push_back(static_cast<std::uint32_t>(random() % points));
      add(soup.corners.back());
    }
    add(std::uint16_t(3));
    soup.end_face();
  }
  return ply;
}

}  // namespace

TEST(Mesh_dialects, PiecesOfATextAreReadLikeTheWhole) {
  std::mt19937 random(1);
  constexpr std::size_t whole = std::size_t(1) << 30;
  for (const dialects::Dialect& dialect : dialects::all()) {
    const std::string extension = std::filesystem::path(dialect.file).extension().string();
    const std::string sound = dialect.content(large_shapes::free_form(6, 4));
    if ((extension != ".off" && extension != ".obj") || sound.empty()) continue;
    for (int damage = 0; damage < 12; ++damage) {
      std::string content = sound;
      if (damage > 0) content[random() % content.size()] = "0.-\n\r# \\f"[random() % 9];
      const auto read = [&](std::size_t size) {
        return outcome_of([&] {
          return extension == ".off" ? mesh_files::read_off("m", content, size)
                                     : mesh_files::read_obj("m", content, size);
        });
      };
      const std::string expected = read(whole);
      for (const std::size_t size : {std::size_t(1), std::size_t(33), std::size_t(500)})
        ASSERT_EQ(read(size), expected) << dialect.name << ", pieces of " << size << " bytes:\n" << content;
    }
  }
}

TEST(Mesh_dialects, BinaryPlyOfManyPolygonsInBothOrdersOfBytes) {
  for (const bool has_high_byte_first : {false, true})
    for (const char* type : {"uchar", "int"}) {
      Polygon_soup soup;
      std::string content = binary_ply_of_polygons(40000, 50000, has_high_byte_first, type, soup);
      const auto outcome = [&] { return outcome_of([&] { return mesh_files::read_ply("m", content); }); };
      EXPECT_TRUE(outcome() == outcome_of([&] { return soup; })) << type;
      content.pop_back();
      EXPECT_EQ(outcome(), "m: the file ends after 49999 of 50000 elements \"face\"");
      content.back() = '\1';
      content[content.size() - 3] = '\x7f';
      content[content.size() - 4] = '\x7f';
      content += '\0';
      EXPECT_NE(outcome().find("m: face 49999: the face names vertex "), std::string::npos) << outcome().substr(0, 99);
    }
}

TEST(Mesh_dialects, CornersOfStlAreNumberedInTheOrderInWhichTheyFirstCome) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> step(-20, 20);
  constexpr std::size_t facets = 30001;
  std::string content(80, ' ');
  const auto add = [&](auto value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    content.append(bytes.data(), bytes.size());
  };
  add(static_cast<std::uint32_t>(facets));
  Polygon_soup soup;
  std::map<std::array<float, 3>, std::uint32_t> number;
  for (std::size_t f = 0; f < facets; ++f) {
    for (int i = 0; i < 3; ++i) add(0.F);
    for (int i = 0; i < 3; ++i) {
      std::array<float, 3> p;
      for (float& x : p) {
        x = float(step(random)) / 8;
        if (x == 0 && random() % 2 == 0) x = -0.F;  // equal to 0
        add(x);
      }
      const auto [found, is_new] = number.emplace(p, static_cast<std::uint32_t>(number.size()));
      if (is_new) soup.points.emplace_back(p[0], p[1], p[2]);
      soup.corners.push_back(found->second);
    }
    add(std::uint16_t(0));
    soup.end_face();
  }
  EXPECT_TRUE(outcome_of([&] { return mesh_files::read_stl("m", content); }) == outcome_of([&] { return soup; }));
}

}  // namespace test_mesh_dialects
