// SPDX-License-Identifier: MIT

// The files that the tool reads and writes, and how it makes a surface of them.

#include "../examples/mesh_files.h"
#include "../examples/segment_mesh/Closest_face.h"
#include "../examples/segment_mesh/Oriented_mesh.h"
#include "../examples/segment_mesh/seeds.h"
#include "../examples/segment_mesh/segment_colors.h"

#include "mesh_bytes.h"

#include <gtest/gtest.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

std::atomic<std::size_t> largest_allocation = 0;

}  // namespace

// Not inlined: the compiler would take the pairs below for mismatches.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size > largest_allocation) largest_allocation = size;
  void* memory = std::malloc(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (size > largest_allocation) largest_allocation = size;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using mesh_bytes::bytes;
using mesh_bytes::Faces;
using mesh_bytes::Order;
using mesh_bytes::tetrahedron_faces;
using mesh_bytes::tetrahedron_points;
using mesh_files::Polygon_soup;
using segment_mesh::Mesh;
using segment_mesh::oriented_mesh;
using segment_mesh::Oriented_mesh;
using segment_mesh::Point;

Faces faces_of(const Polygon_soup& soup) {
  Faces faces;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) faces.emplace_back(soup.face(f).begin(), soup.face(f).end());
  return faces;
}

Polygon_soup soup_of(const std::vector<Point>& points, const Faces& faces) {
  Polygon_soup soup;
  soup.points = points;
  for (const auto& face : faces) {
    for (const std::size_t corner : face) soup.corners.push_back(static_cast<Polygon_soup::Index>(corner));
    soup.end_face();
  }
  return soup;
}

class File_test : public testing::Test {
 protected:
  File_test() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~File_test() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  std::size_t number_of_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rw_" + std::to_string(std::random_device()()));
};

// ---- Reading ----

std::string binary_ply_tetrahedron(Order order) {
  std::string file = "ply\nformat binary_" + std::string(order == Order::little ? "little" : "big") +
                     "_endian 1.0\ncomment # no comment\\\nelement vertex 4\nproperty float x\nproperty double y\n"
                     "property float z\nproperty uchar red\nelement edge 1\nproperty int vertex1\nproperty list uchar "
                     "short more\nelement face 4\nproperty uchar flag\nproperty list ushort uint vertex_index\n"
                     "end_header\n";
  for (const Point& p : tetrahedron_points)
    file += bytes({static_cast<float>(p.x())}, order) + bytes({p.y()}, order) +
            bytes({static_cast<float>(p.z())}, order) + "r";
  file += bytes<std::int32_t>({7}, order) + bytes<std::uint8_t>({2}, order) + bytes<std::int16_t>({-1, 1}, order);
  for (const auto& f : tetrahedron_faces)
    file += "f" + bytes<std::uint16_t>({3}, order) +
            bytes<std::uint32_t>({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])}, order);
  return file;
}

std::string binary_stl_tetrahedron() {
  std::string file = "solid as some programs write it";
  file.resize(80, ' ');
  file += bytes<std::uint32_t>({4}, Order::little);
  for (const auto& f : tetrahedron_faces) {
    file += std::string(12, '\0');
    for (const std::size_t v : f)
      for (int i = 0; i < 3; ++i) file += bytes({static_cast<float>(tetrahedron_points[v][i])}, Order::little);
    file += std::string(2, '\0');
  }
  return file;
}

std::string text_stl_tetrahedron() {
  std::ostringstream file;
  file << "solid\r\n";
  for (const auto& f : tetrahedron_faces) {
    file << "facet normal nan nan nan\r\n outer loop\r\n";
    for (const std::size_t v : f) file << "  VERTEX " << tetrahedron_points[v] << "\r\n";
    file << " endloop\r\nendfacet\r\n";
  }
  file << "endsolid\r\n";
  return file.str();
}

const std::string off_tetrahedron = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 0.5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST_F(File_test, AllFormatsGiveTheSameTetrahedron) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"plain.off", off_tetrahedron},
      {"counts_in_the_first_line.off", "OFF 4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 0.5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3"},
      {"comments_and_colors.off",
       "# by hand\n\nCOFF # colours\n4 4\n\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n# half way\n 0 1e0 0. 1 0 0 1\n"
       "+0 -0 5e-1 1 0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 # red\n3 1 2 3\n3 2 0 3 7\nthe rest is not read\n"},
      {"dos.off", "OFF\r\n4 4 6\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 0.5\r\n3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 2 0 3\r\n"},
      {"old_mac.off", "OFF\r4 4 6\r0 0 0\r1 0 0\r0 1 0\r0 0 0.5\r3 0 2 1\r3 0 1 3\r3 1 2 3\r3 2 0 3\r"},
      {"text.ply",
       "ply\nformat ascii 1.0\ncomment a\\\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "property float confidence\nelement face 4\nproperty list uchar int vertex_indices\nproperty uchar red\n"
       "end_header\n0 0 0 nan\n1 0 0 1\n0 1 0 1\n0 0 0.5 1\n3 0 2 1 9\n3 0 1 3 9\n3 1 2 3 9\n3 2 0 3 9\n"},
      {"little.ply", binary_ply_tetrahedron(Order::little)},
      {"big.ply", binary_ply_tetrahedron(Order::big)},
      {"plain.obj",
       "mtllib t.mtl\no t\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.1 0.2 0.3\nv 0 0 0.5\nvn 0 0 1\nvt 0 0\ns off\nf 1/1/1 "
       "3/1/1 2/1/1\nf 1//1 2//1 4//1\ng more\nf -3 -2 \\\n-1\nf 3/1 1/1 4/1\n"},
      {"vertices_last.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.5\n"},
      {"no_extension", off_tetrahedron}};
  for (const auto& [name, content] : files) {
    const Polygon_soup soup = mesh_files::read_mesh(write(name, content));
    EXPECT_EQ(soup.points, tetrahedron_points) << name;
    EXPECT_EQ(faces_of(soup), tetrahedron_faces) << name;
  }
  // STL has no order of the vertices but that of the faces' corners.
  for (const auto& [name, content] : {std::pair<std::string, std::string>("text.stl", text_stl_tetrahedron()),
                                      {"binary.stl", binary_stl_tetrahedron()},
                                      {"binary_stl_named.off", binary_stl_tetrahedron()}}) {
    const Polygon_soup soup = mesh_files::read_mesh(write(name, content));
    ASSERT_EQ(soup.points.size(), 4U) << name;
    ASSERT_EQ(soup.number_of_faces(), 4U) << name;
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(soup.points[soup.face(f)[static_cast<std::ptrdiff_t>(i)]],
                  tetrahedron_points[tetrahedron_faces[f][i]])
            << name;
  }
}

TEST_F(File_test, ReadsWhatCgalReads) {
#ifndef RW_SEGMENTATION_DATA_DIR
  GTEST_SKIP() << "CGAL's data meshes were not found";
#else
  for (const char* name : {"bear.off", "boeing.off", "mpi.off", "mesh_with_colors.off", "sphere.ply",
                           "colored_tetra.ply", "pig.stl", "sphere.stl", "P.off"}) {
    const std::string path = std::string(RW_SEGMENTATION_DATA_DIR) + "/meshes/" + name;
    std::vector<Point> points;
    Faces faces;
    ASSERT_TRUE(CGAL::IO::read_polygon_soup(path, points, faces)) << name;
    const Polygon_soup soup = mesh_files::read_mesh(path);
    EXPECT_EQ(faces_of(soup).size(), faces.size()) << name;
    if (mesh_files::extension_of(path) == ".stl") continue;  // CGAL merges points in another order
    EXPECT_EQ(soup.points, points) << name;
    EXPECT_EQ(faces_of(soup), faces) << name;
  }
#endif
}

TEST_F(File_test, VeryLargeAndVerySmallNumbersAreRead) {
  const Polygon_soup soup = mesh_files::read_mesh(
      write("range.off", "OFF\n3 1 0\n1e150 -1e308 0\n1e-160 4e-324 0\n1e-400 -1e-999 0\n3 0 1 2\n"));
  EXPECT_EQ(soup.points[0], Point(1e150, -1e308, 0));
  EXPECT_EQ(soup.points[1], Point(1e-160, std::numeric_limits<double>::denorm_min(), 0));
  EXPECT_EQ(soup.points[2], Point(0, 0, 0));
}

struct Bad_file {
  std::string name, content, message;  // the message follows the path
};

std::vector<Bad_file> bad_files() {
  const std::string ply_header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string little = binary_ply_tetrahedron(Order::little);
  const std::string stl = binary_stl_tetrahedron();
  std::string garbage(2000, '\0');
  std::mt19937 random(1);
  for (char& c : garbage) c = static_cast<char>(random());
  return {
      {"empty.off", "", ": the file is empty"},
      {"empty.stl", "", ": the file is empty"},
      {"blank.ply", " \n\r\n\t ", ": the file is empty"},
      {"garbage.off", garbage, ":1: an OFF file starts with OFF"},
      {"garbage.ply", garbage, ": a PLY file starts with \"ply\""},
      {"garbage.obj", garbage, ": no line of the file is an OBJ vertex"},
      {"garbage.stl", garbage, ": the header promises"},
      {"garbage.xyz", garbage, ": this is no OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file"},
      {"text.off", "to be\nor not to be\n", ":1: an OFF file starts with OFF, this one with 'to'"},
      {"text.obj", "to be\nor not to be\n", ": no line of the file is an OBJ vertex"},
      {"ply_named.off", "ply\nformat ascii 1.0\nend_header\n", ":3: the header has no element \"vertex\""},
      {"header_only.off", "OFF\n", ":1: the file ends here, after the header"},
      {"two_dimensions.off", "OFF\n3 1 0\n0 0\n1 0\n0 1\n3 0 1 2\n", ":3: the z coordinate is missing"},
      {"n_dimensions.off", "nOFF\n2\n1 0 0\n0 0\n", ":2: the mesh has 2 dimensions"},
      {"binary.off", "OFF BINARY\n123", ":1: this is a binary OFF file"},
      {"no_counts.off", "OFF\nzero\n", ":2: the number of vertices is 'zero', not a whole number"},
      {"negative_count.off", "OFF\n-3 1 0\n", ":2: the number of vertices is negative: -3"},
      {"lying_vertices.off", "OFF\n4000000000 1 0\n0 0 0\n", ":2: the header promises 4000000000 vertices"},
      {"lying_faces.off", "OFF\n1 9000000000000000000 0\n0 0 0\n", ":2: the header promises 1 vertices and 9000"},
      {"overflowing_count.off", "OFF\n99999999999999999999 1 0\n0 0 0\n", ":2: the number of vertices is '99999"},
      {"cut_in_vertices.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ":4: the file ends here, after 2 of 3 vertices"},
      {"cut_in_faces.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":6: the file ends here, after 1 of 2 faces"},
      {"cut_in_a_face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", ":6: a corner of the face is missing"},
      {"no_number.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", ":4: the y coordinate is 'x', not a number"},
      {"half_a_number.off", "OFF\n3 1 0\n0 0 0\n1 2.5abc 0\n", ":4: the y coordinate is '2.5abc'"},
      {"nan.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", ":4: the z coordinate is not finite"},
      {"infinite.off", "OFF\n3 1 0\n0 0 0\n-inf 0 0\n0 1 0\n3 0 1 2\n", ":4: the x coordinate is not finite"},
      {"overflow.off", "OFF\n3 1 0\n0 0 0\n1e400 0 0\n0 1 0\n3 0 1 2\n", ":4: the x coordinate is not finite"},
      {"no_such_vertex.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       ":6: the face names vertex 3, the file has 3"},
      {"negative_vertex.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
       ":6: a corner of the face is negative: -1"},
      {"huge_degree.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", ":6: a corner of the face is missing"},
      {"zero.obj", "v 0 0 0\nf 0 1 1\n", ":2: the face names vertex 0"},
      {"before_the_first.obj", "v 0 0 0\nf -2 1 1\n", ":2: the face names vertex -2"},
      {"after_the_last.obj", "v 0 0 0\nf 1 1 1\nf 1 1 2\nv 0\n", ":4: the y coordinate is missing"},
      {"after_the_end.obj", "v 0 0 0\nf 1 1 1\nf 1 1 2\n", ":3: the face names vertex 2, the file has 1"},
      {"overflow.obj", "v 0 0 0\nf 1 1 99999999999\n", ":2: the face names vertex 99999999999"},
      {"no_corner.obj", "v 0 0 0\nf 1 x 1\n", ":2: the corner of a face is 'x'"},
      {"nan.obj", "v 0 0 0\nv 0 nan 0\n", ":2: the y coordinate is not finite"},
      {"cut_header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n",
       ":3: the file ends here, after part of the header"},
      {"no_format.ply", "ply\nelement vertex 0\nend_header\n", ":3: the header has no line \"format\""},
      {"unknown_format.ply", "ply\nformat gzip 1.0\n", ":2: no format of PLY is called 'gzip'"},
      {"unknown_type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", ":4: no scalar type"},
      {"unknown_line.ply", "ply\nformat ascii 1.0\nelment vertex 1\n",
       ":3: the file ends here, after part of the header"},
      {"stray_property.ply", "ply\nformat ascii 1.0\nproperty float x\n", ":3: a property before the first element"},
      {"two_x.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\n",
       ":5: a second property 'x'"},
      {"no_z.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face 0\nend_header\n0 0\n",
       ":7: element \"vertex\" has no property \"z\""},
      {"no_faces.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 "
       "0\n",
       ":7: the header has no element \"face\""},
      {"strips.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int strip\nend_header\n0 0 0\n3 0 0 0\n",
       ":9: element \"face\" has no property \"vertex_indices\""},
      {"lying_text.ply",
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 0\nend_header\n0 0 0\n",
       ":8: the header promises 4000000000 elements \"vertex\""},
      {"lying_binary.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n" +
           std::string(40, '\0'),
       ":9: the header promises 4000000000 elements \"face\""},
      {"cut_text.ply", ply_header, ":9: the header promises 1 elements \"vertex\""},
      {"cut_after_vertices.ply", ply_header + "0 0 0\n", ":10: the file ends here, after 0 of 1 elements \"face\""},
      {"nan.ply", ply_header + "0 nan 0\n3 0 0 0\n", ":10: the y coordinate is not finite"},
      {"no_such_vertex.ply", ply_header + "0 0 0\n3 0 0 1\n", ":11: the face names vertex 1, the file has 1"},
      {"negative_vertex.ply", ply_header + "0 0 0\n3 0 0 -1\n", ":11: a corner of the face is -1"},
      {"fraction.ply", ply_header + "0 0 0\n3 0 0 0.5\n", ":11: a corner of the face is 0.5"},
      {"huge_list.ply", ply_header + "0 0 0\n4000000000 0 0 0\n", ":11: a value is missing"},
      {"cut_binary.ply", little.substr(0, little.size() - 1), ": the file ends after 3 of 4 elements \"face\""},
      {"cut_facet.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", ":4: the file ends here"},
      {"two_corners.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nendloop\nendfacet\nendsolid\n",
       ":7: the facet has 2 of 3 vertices"},
      {"four_corners.stl", "solid\nfacet\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\n",
       ":6: a vertex too many"},
      {"nested.stl", "solid\nfacet\nfacet\n", ":3: a facet within a facet"},
      {"unknown_word.stl", "solid\nfacette\n", ":2: no line of an STL file starts with 'facette'"},
      {"nan.stl", "solid\nfacet\nvertex 0 0 nan\n", ":3: the z coordinate is not finite"},
      {"cut_header.stl", stl.substr(80, 3), ": an STL file starts with \"solid\" or has a header of 84 bytes"},
      {"cut_binary.stl", "SCAN" + stl.substr(4, stl.size() - 7),
       ": the header promises 4 facets, which take 284 bytes"},
      {"infinite_binary.stl",
       "SCAN" + stl.substr(4, 84 + 12 - 4) + bytes({std::numeric_limits<float>::infinity()}, Order::little) +
           stl.substr(84 + 16),
       ": facet 0 has a coordinate that is not finite"}};
}

TEST_F(File_test, BadFilesAreRefusedWithTheirPlaceAndCause) {
  for (const auto& [name, content, message] : bad_files()) {
    const std::string file = write(name, content);
    try {
      mesh_files::read_mesh(file);
      ADD_FAILURE() << name << " was read";
    } catch (const mesh_files::Unreadable_file& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.compare(0, file.size(), file), 0) << what;
      EXPECT_NE(what.find(message), std::string::npos) << what << "\ndoes not say " << message;
      EXPECT_TRUE(std::all_of(what.begin(), what.end(), [](char c) { return c >= ' ' && c <= '~'; })) << what;
    }
  }
  EXPECT_THROW(mesh_files::read_mesh(path("missing.off")), mesh_files::Unreadable_file);
  EXPECT_THROW(mesh_files::read_mesh(path("")), mesh_files::Unreadable_file);  // a folder
}

TEST_F(File_test, AHeaderThatLiesAllocatesNoMoreThanTheFileIsWorth) {
  for (const auto& [name, content, message] : bad_files()) {
    const std::string file = write(name, content);
    largest_allocation = 0;
    EXPECT_THROW(mesh_files::read_mesh(file), mesh_files::Unreadable_file);
    EXPECT_LE(largest_allocation, 100 * content.size() + 10000) << name;
  }
}

TEST_F(File_test, DamagedFilesAreReadOrRefusedButNeverHarm) {
  std::mt19937 random(42);
  const std::vector<std::pair<std::string, std::string>> originals = {
      {"d.off", off_tetrahedron},
      {"l.ply", binary_ply_tetrahedron(Order::little)},
      {"b.ply", binary_ply_tetrahedron(Order::big)},
      {"t.stl", text_stl_tetrahedron()},
      {"b.stl", binary_stl_tetrahedron()},
      {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2//2 -1\nf 3 2 1\n"}};
  std::size_t read = 0, refused = 0;
  for (const auto& [name, original] : originals)
    for (int i = 0; i < 3000; ++i) {
      std::string content = original;
      for (unsigned damage = random() % 4 + 1; damage > 0 && !content.empty(); --damage) {
        const std::size_t at = random() % content.size();
        switch (random() % 4) {
          case 0:
            content[at] = static_cast<char>(random());
            break;
          case 1:
            content.erase(at, random() % 20 + 1);
            break;
          case 2:
            content.insert(at, content.substr(random() % content.size(), random() % 20));
            break;
          default:
            content.resize(at);
            break;
        }
      }
      largest_allocation = 0;
      try {
        // The readers themselves: what `read_mesh()` adds is the choice between them.
        const Polygon_soup soup = name == "d.off"   ? mesh_files::read_off(name, content)
                                  : name == "d.obj" ? mesh_files::read_obj(name, content)
                                  : name[2] == 'p'  ? mesh_files::read_ply(name, content)
                                                    : mesh_files::read_stl(name, content);
        ++read;
        for (const auto corner : soup.corners) ASSERT_LT(corner, soup.points.size());
        for (const Point& p : soup.points) ASSERT_TRUE(std::isfinite(p.x() + p.y() + p.z()));
        ASSERT_EQ(soup.first_corner.back(), soup.corners.size());
      } catch (const mesh_files::Unreadable_file&) {
        ++refused;
      }
      ASSERT_LE(largest_allocation, 100 * content.size() + 10000);
    }
  EXPECT_GT(read, 500U);
  EXPECT_GT(refused, 500U);
}

// ---- Writing ----

TEST_F(File_test, WhatIsWrittenIsReadBackExactly) {
  Polygon_soup soup = soup_of({{0.1, 1e300, -1. / 3}, {5e-324, 0, 2}, {1, 2, 3}, {4, 5, 6}}, {{0, 1, 2}, {3, 2, 1, 0}});
  for (Polygon_soup::Index i = 0; i < 300; ++i) soup.corners.push_back(i % 4);
  soup.end_face();
  for (const std::size_t faces : {std::size_t(2), std::size_t(3)}) {  // without and with a face of 300 corners
    Polygon_soup part = soup;
    part.first_corner.resize(faces + 1);
    part.corners.resize(part.first_corner.back());
    const std::vector<mesh_files::Color> face_colors(faces, {1, 2, 255});
    for (const bool has_point_colors : {false, true}) {
      const mesh_files::Colors colors =
          has_point_colors ? mesh_files::colors_of_points(part, face_colors) : mesh_files::colors_of_faces(face_colors);
      const std::vector<std::size_t> labels(faces, 7);
      mesh_files::Output_file off(path("out.off")), ply(path("out.ply")), obj(path("out.obj"));
      mesh_files::write_off(off, part, colors);
      mesh_files::write_ply(ply, part, colors, labels);
      mesh_files::write_obj(obj, "out.mtl", part, colors, labels);
      off.commit();
      ply.commit();
      obj.commit();
      for (const char* name : {"out.off", "out.ply", "out.obj"}) {
        const Polygon_soup again = mesh_files::read_mesh(path(name));
        EXPECT_EQ(again.points, soup.points) << name;
        EXPECT_EQ(faces_of(again), faces_of(part)) << name;
      }
    }
  }
}

TEST_F(File_test, CgalReadsTheColorsAndLabelsOfAPlyFile) {
  const Polygon_soup soup = soup_of(tetrahedron_points, tetrahedron_faces);
  mesh_files::Output_file ply(path("out.ply"));
  mesh_files::write_ply(ply, soup, mesh_files::colors_of_faces({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 255}}),
                        {3, 1, 4, 1000000});
  ply.commit();
  Mesh mesh;
  std::ifstream file(path("out.ply"), std::ios::binary);
  CGAL::IO::set_mode(file, CGAL::IO::BINARY);
  ASSERT_TRUE(CGAL::IO::read_PLY(file, mesh));
  const auto [color, color_is_new] = mesh.add_property_map<Mesh::Face_index, CGAL::IO::Color>("f:color");
  const auto [label, label_is_new] = mesh.add_property_map<Mesh::Face_index, std::uint32_t>("f:segment");
  ASSERT_FALSE(color_is_new);
  ASSERT_FALSE(label_is_new);
  EXPECT_EQ(color[Mesh::Face_index(0)], CGAL::IO::Color(1, 2, 3));
  EXPECT_EQ(color[Mesh::Face_index(3)], CGAL::IO::Color(10, 11, 255));
  EXPECT_EQ(label[Mesh::Face_index(3)], 1000000U);
}

TEST_F(File_test, PointsBetweenSegmentsAreWrittenOnceForEach) {
  // Two squares side by side and one above the first: three segments, and a point that no face has.
  const Polygon_soup soup =
      soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {9, 9, 9}},
              {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}});
  const std::vector<std::size_t> labels = {5, 7, 5};
  const Polygon_soup apart = mesh_files::with_points_apart(soup, labels);
  EXPECT_EQ(apart.points.size(), 11U);  // the two points of the edge between 5 and 7 twice
  ASSERT_EQ(apart.first_corner, soup.first_corner);
  for (std::size_t i = 0; i < soup.corners.size(); ++i)
    EXPECT_EQ(apart.points[apart.corners[i]], soup.points[soup.corners[i]]);
  const std::vector<mesh_files::Color> colors = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const mesh_files::Colors of_points = mesh_files::colors_of_points(apart, colors);
  for (std::size_t f = 0; f < 3; ++f)
    for (const auto corner : apart.face(f)) EXPECT_EQ(of_points.of_points[corner], colors[f]);
}

TEST_F(File_test, AnOutputAppearsWholeOrNotAtAll) {
  write("old.seg", "old");
  {
    mesh_files::Output_file file(path("old.seg"));
    file.write("new");
    file.flush();
  }
  EXPECT_EQ(mesh_files::read_content(path("old.seg")), "old");
  EXPECT_EQ(number_of_files(), 1U);
  mesh_files::Output_file file(path("old.seg"));
  file.write("new");
  file.commit();
  EXPECT_EQ(mesh_files::read_content(path("old.seg")), "new");
  EXPECT_EQ(number_of_files(), 1U);
  EXPECT_THROW(mesh_files::Output_file(path("no_such_folder/a.seg")), mesh_files::Unwritable_file);
  EXPECT_THROW(mesh_files::Output_file(path("")), mesh_files::Unwritable_file);  // a folder
}

TEST_F(File_test, AnOutputHasThePermissionsOfTheFileThatItReplaces) {
  using std::filesystem::perms;
  const std::string old = write("old.seg", "old"), link = path("link.seg");
  std::filesystem::create_symlink("old.seg", link);
  for (const std::string& name : {old, link})
    for (const perms wanted : {perms::owner_read | perms::owner_write, perms::owner_read, perms::all}) {
      std::filesystem::permissions(old, wanted);
      mesh_files::Output_file file(name);
      file.write("new");
      EXPECT_EQ(number_of_files(), 3U);  // the unfinished one, too
      for (const auto& entry : std::filesystem::directory_iterator(path("")))
        EXPECT_EQ(entry.status().permissions(), wanted) << entry.path();
      file.commit();
      EXPECT_EQ(std::filesystem::status(old).permissions(), wanted);
      EXPECT_EQ(mesh_files::read_content(old), "new");
    }
}

TEST_F(File_test, LabelsThatAPlyFileCannotHoldAreRefused) {
  const Polygon_soup soup = soup_of(tetrahedron_points, tetrahedron_faces);
  constexpr std::size_t largest = std::numeric_limits<std::uint32_t>::max();
  mesh_files::Output_file ply(path("out.ply"));
  mesh_files::write_ply(ply, soup, {}, {0, 1, 2, largest});
  EXPECT_THROW(mesh_files::write_ply(ply, soup, {}, {0, 1, 2, largest + 1}), mesh_files::Unwritable_file);
}

// ---- A surface of the faces of a file ----

const std::vector<Point> cube_points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Faces cube_faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::vector<Point> scaled_cube(double size, double offset) {
  std::vector<Point> points;
  for (const Point& p : cube_points)
    points.emplace_back(offset + size * p.x(), offset + size * p.y(), offset + size * p.z());
  return points;
}

/// The points of the mesh's face for each face of the file, from the lowest corner on.
Faces corners_in_file_order(const Oriented_mesh& input) {
  Faces result;
  for (const auto f : input.mesh_face) {
    std::vector<std::size_t> corners;
    if (f != Mesh::null_face())
      for (const auto v : input.mesh.vertices_around_face(input.mesh.halfedge(f)))
        corners.push_back(static_cast<std::size_t>(
            std::find(cube_points.begin(), cube_points.end(), input.mesh.point(v)) - cube_points.begin()));
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(corners);
  }
  return result;
}

bool is_mentioned(const Oriented_mesh& input, const std::string& text) {
  return std::any_of(input.remarks.begin(), input.remarks.end(),
                     [&](const std::string& remark) { return remark.find(text) != std::string::npos; });
}

TEST(Oriented_mesh_test, AProperFileIsTakenAsItIs) {
  const Oriented_mesh input = oriented_mesh(soup_of(cube_points, cube_faces), {});
  EXPECT_TRUE(input.remarks.empty());
  EXPECT_EQ(corners_in_file_order(input)[3], cube_faces[3]);
  EXPECT_TRUE(CGAL::is_closed(input.mesh));
}

TEST(Oriented_mesh_test, AnEmptyFileIsAnEmptyMesh) {
  const Oriented_mesh input = oriented_mesh(Polygon_soup(), {});
  EXPECT_TRUE(input.mesh.is_empty());
  EXPECT_TRUE(input.remarks.empty());
}

TEST(Oriented_mesh_test, SeparateFacesAreStitchedInTheOrderOfTheFile) {
  std::vector<Point> points;
  Faces faces;
  for (const auto& face : cube_faces) {
    faces.emplace_back();
    for (const std::size_t corner : face) {
      faces.back().push_back(points.size());
      points.push_back(cube_points[corner]);
    }
  }
  const Oriented_mesh input = oriented_mesh(soup_of(points, faces), {});
  EXPECT_TRUE(CGAL::is_closed(input.mesh));
  EXPECT_EQ(corners_in_file_order(input), corners_in_file_order(oriented_mesh(soup_of(cube_points, cube_faces), {})));
  EXPECT_TRUE(is_mentioned(input, "merged 16 vertices"));

  segment_mesh::Repairs repairs;
  repairs.stitch = false;
  EXPECT_EQ(oriented_mesh(soup_of(points, faces), repairs).mesh.number_of_vertices(), 24U);
}

TEST(Oriented_mesh_test, FlippedFacesAreTurnedToMatchTheirNeighbours) {
  Faces faces = cube_faces;
  for (const std::size_t f : {1U, 4U}) std::reverse(faces[f].begin(), faces[f].end());
  const Oriented_mesh input = oriented_mesh(soup_of(cube_points, faces), {});
  EXPECT_TRUE(is_mentioned(input, "turned "));
  EXPECT_EQ(corners_in_file_order(input), corners_in_file_order(oriented_mesh(soup_of(cube_points, cube_faces), {})));
}

TEST(Oriented_mesh_test, AMeshInsideOutIsTurnedUnlessThatIsNotWanted) {
  Faces faces = cube_faces;
  for (auto& face : faces) std::reverse(face.begin(), face.end());
  const Oriented_mesh turned = oriented_mesh(soup_of(cube_points, faces), {});
  EXPECT_TRUE(is_mentioned(turned, "turned 1 closed part"));
  EXPECT_EQ(corners_in_file_order(turned), corners_in_file_order(oriented_mesh(soup_of(cube_points, cube_faces), {})));

  segment_mesh::Repairs repairs;
  repairs.orient = false;
  const Oriented_mesh kept = oriented_mesh(soup_of(cube_points, faces), repairs);
  EXPECT_TRUE(kept.remarks.empty());
  EXPECT_NE(corners_in_file_order(kept), corners_in_file_order(turned));
}

TEST(Oriented_mesh_test, TheWallOfACavityStaysAsItIs) {
  std::vector<Point> points = scaled_cube(3, -1);
  points.insert(points.end(), cube_points.begin(), cube_points.end());
  Faces faces = cube_faces;
  for (auto face : cube_faces) {
    for (std::size_t& corner : face) corner += 8;
    std::reverse(face.begin(), face.end());
    faces.push_back(face);
  }
  EXPECT_TRUE(oriented_mesh(soup_of(points, faces), {}).remarks.empty());

  // Beside the other cube it is inside out.
  for (std::size_t v = 8; v < 16; ++v) points[v] = Point(points[v].x() + 10, points[v].y(), points[v].z());
  EXPECT_TRUE(is_mentioned(oriented_mesh(soup_of(points, faces), {}), "turned 1 closed part"));
}

TEST(Oriented_mesh_test, OrientationIsRecognisedAtEveryScale) {
  for (const double size : {1e-160, 1e-3, 1e150})
    for (const double offset : {0., 1e6 * size}) {
      Faces faces = cube_faces;
      EXPECT_TRUE(oriented_mesh(soup_of(scaled_cube(size, offset), faces), {}).remarks.empty()) << size;
      for (auto& face : faces) std::reverse(face.begin(), face.end());
      EXPECT_EQ(oriented_mesh(soup_of(scaled_cube(size, offset), faces), {}).remarks.size(), 1U) << size;
    }
}

TEST(Oriented_mesh_test, ASurfaceIsSplitWhereThreeFacesMeetAtAnEdge) {
  const Oriented_mesh input = oriented_mesh(
      soup_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), {});
  EXPECT_TRUE(is_mentioned(input, "split the surface along 1 edge "));
  EXPECT_EQ(input.mesh.number_of_faces(), 3U);
  EXPECT_EQ(std::count(input.mesh_face.begin(), input.mesh_face.end(), Mesh::null_face()), 0);
  EXPECT_TRUE(input.mesh.is_valid());
}

TEST(Oriented_mesh_test, TwoClosedPartsThatShareAVertexAreKept) {
  std::vector<Point> points = cube_points;
  Faces faces = cube_faces;
  for (const Point& p : cube_points)
    if (p != CGAL::ORIGIN) points.emplace_back(-p.x(), -p.y(), -p.z());
  for (auto face : cube_faces) {
    for (std::size_t& corner : face) corner = corner == 0 ? 0 : corner + 7;
    std::reverse(face.begin(), face.end());
    faces.push_back(face);
  }
  const Oriented_mesh input = oriented_mesh(soup_of(points, faces), {});
  EXPECT_EQ(input.mesh.number_of_faces(), 12U);
  EXPECT_TRUE(CGAL::is_closed(input.mesh));
  EXPECT_TRUE(input.mesh.is_valid());
}

TEST(Oriented_mesh_test, FacesThatNoSurfaceHasAreLeftOut) {
  Faces faces = cube_faces;
  faces.insert(faces.begin() + 1, {0, 1, 1});                   // two different corners
  faces.insert(faces.begin() + 3, {1, 0, 3, 2});                // the first face again
  faces.insert(faces.begin() + 5, std::vector<std::size_t>());  // none at all
  faces.push_back({7});
  const Oriented_mesh input = oriented_mesh(soup_of(cube_points, faces), {});
  EXPECT_TRUE(is_mentioned(input, "4 faces of the file left out"));
  ASSERT_EQ(input.mesh_face.size(), 10U);
  for (const std::size_t f : {1U, 3U, 5U, 9U}) EXPECT_EQ(input.mesh_face[f], Mesh::null_face()) << f;
  const Faces corners = corners_in_file_order(input);
  EXPECT_EQ(corners[2], corners_in_file_order(oriented_mesh(soup_of(cube_points, cube_faces), {}))[1]);
  EXPECT_TRUE(CGAL::is_closed(input.mesh));
}

TEST(Oriented_mesh_test, AFaceThatTouchesItselfIsSplit) {
  // Two triangles with a common corner, given as one face of six corners.
  const Oriented_mesh input = oriented_mesh(
      soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, 0, 1}}, {{0, 1, 2, 0, 3, 4}, {1, 0, 5}}),
      {});
  EXPECT_EQ(input.mesh.number_of_faces(), 3U);
  EXPECT_TRUE(is_mentioned(input, "split 1 face "));
  EXPECT_NE(input.mesh_face[0], Mesh::null_face());
  EXPECT_TRUE(input.mesh.is_valid());
}

TEST(Oriented_mesh_test, MeshesOfTheWorldBecomeValidSurfaces) {
#ifndef RW_SEGMENTATION_DATA_DIR
  GTEST_SKIP() << "CGAL's data meshes were not found";
#else
  for (const char* name : {"boeing.off", "blobby-shuffled.off", "elephant-with-holes.off", "mpi.off", "pig.stl",
                           "tetra_intersected_by_triangle.off", "b9_mesh.off", "oblong-shuffled.off"}) {
    const Polygon_soup soup = mesh_files::read_mesh(std::string(RW_SEGMENTATION_DATA_DIR) + "/meshes/" + name);
    const Oriented_mesh input = oriented_mesh(soup, {});
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(input.mesh)) << name;
    EXPECT_EQ(input.mesh_face.size(), soup.number_of_faces()) << name;
    for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
      std::multiset<Point> expected, found;
      for (const auto corner : soup.face(f)) expected.insert(soup.points[corner]);
      ASSERT_NE(input.mesh_face[f], Mesh::null_face()) << name;
      for (const auto v : input.mesh.vertices_around_face(input.mesh.halfedge(input.mesh_face[f])))
        found.insert(input.mesh.point(v));
      ASSERT_EQ(found, expected) << name << " face " << f;
    }
  }
#endif
}

// ---- Seeds and colours ----

Mesh wavy_grid(std::size_t n) {
  std::vector<Point> points;
  Faces faces;
  for (std::size_t y = 0; y <= n; ++y)
    for (std::size_t x = 0; x <= n; ++x) {
      const double u = static_cast<double>(x), v = static_cast<double>(y);
      points.emplace_back(u, v, std::sin(u) * std::cos(v));
    }
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) {
      const std::size_t a = y * (n + 1) + x;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return oriented_mesh(soup_of(points, faces), {}).mesh;
}

TEST(Closest_face_test, IsThatOfASearchThroughAllFaces) {
  const Mesh mesh = wavy_grid(12);
  const segment_mesh::Closest_face closest(mesh);
  using Triangle = CGAL::Simple_cartesian<double>::Triangle_3;
  const auto distance = [&](const Point& p, Mesh::Face_index f) {
    std::vector<Point> c;
    for (auto h = mesh.halfedge(f); c.size() < 4; h = mesh.next(h)) c.push_back(mesh.point(mesh.source(h)));
    return std::min(CGAL::squared_distance(p, Triangle(c[0], c[1], c[2])),
                    CGAL::squared_distance(p, Triangle(c[0], c[2], c[3])));
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-3, 15);
  for (int i = 0; i < 300; ++i) {
    const Point p(coordinate(random), coordinate(random), coordinate(random));
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto f : mesh.faces()) smallest = std::min(smallest, distance(p, f));
    EXPECT_EQ(distance(p, closest(p)), smallest);
  }
}

TEST(Closest_face_test, TheFirstOfSeveralWins) {
  const Mesh mesh = wavy_grid(6);
  const segment_mesh::Closest_face closest(mesh);
  for (const auto v : mesh.vertices()) {
    std::size_t first = mesh.number_of_faces();
    for (const auto f : mesh.faces_around_target(mesh.halfedge(v)))
      if (f != Mesh::null_face()) first = std::min(first, static_cast<std::size_t>(f));
    EXPECT_EQ(static_cast<std::size_t>(closest(mesh.point(v))), first);
  }
}

TEST(Seeds_test, TextsBecomeSeeds) {
  using segment_mesh::seed_argument;
  EXPECT_EQ(std::get<std::size_t>(seed_argument("12").place), 12U);
  EXPECT_FALSE(seed_argument("12").label);
  EXPECT_EQ(*seed_argument("12=3").label, 3U);
  EXPECT_EQ(*seed_argument(" 12 = 3 ").label, 3U);
  EXPECT_EQ(std::get<Point>(seed_argument("1,-2.5,+3e2=4").place), Point(1, -2.5, 300));
  EXPECT_EQ(std::get<Point>(seed_argument("1 2 3").place), Point(1, 2, 3));
  for (const char* wrong : {"", "=", "a", "-1", "1.5", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1=", "1=x", "1=-2",
                            "1=1.5", "1=3000000000", "99999999999999999999", "1=2=3", "1,2,3x"})
    EXPECT_THROW(seed_argument(wrong), std::invalid_argument) << wrong;
}

TEST(Seeds_test, SeedsWithoutALabelGetTheLowestUnused) {
  std::vector<segment_mesh::Seed_argument> seeds;
  for (const char* text : {"10", "11=1", "12", "13=0", "14"}) seeds.push_back(segment_mesh::seed_argument(text));
  complete_labels(seeds);
  std::vector<std::size_t> labels;
  for (const auto& seed : seeds) labels.push_back(*seed.label);
  EXPECT_EQ(labels, (std::vector<std::size_t>{2, 1, 3, 0, 4}));
}

TEST(Segment_colors_test, NeighboursNeverHaveTheSameColor) {
  const Mesh mesh = wavy_grid(80);
  std::mt19937 random(3);
  for (const std::size_t segments : {1U, 2U, 8U, 9U, 40U, 700U}) {
    // Scattered segments: with 40 of them all are neighbours of all.
    std::vector<std::size_t> segment(mesh.number_of_faces());
    for (std::size_t f = 0; f < segment.size(); ++f) segment[f] = f < segments ? f : random() % segments;
    if (segments == 700) std::sort(segment.begin(), segment.end());  // strips
    const auto colors = segment_mesh::segment_colors(mesh, segment, segments);
    ASSERT_EQ(colors.size(), segments);
    for (const auto& [a, b] : segment_mesh::neighbouring_segments(mesh, segment)) ASSERT_NE(colors[a], colors[b]);
    if (segments > 40) continue;
    EXPECT_EQ(std::set<mesh_files::Color>(colors.begin(), colors.end()).size(), segments);
  }
}

/// A colour in CIELAB as those see it who lack the cones for green (Vienot, Brettel and Mollon 1999), or as all others.
std::array<double, 3> cielab(const mesh_files::Color& color, bool lacks_green) {
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = std::pow(color[i] / 255., 2.2);
  if (lacks_green)
    c = {0.29275 * c[0] + 0.70725 * c[1], 0.29275 * c[0] + 0.70725 * c[1], -0.02234 * c[0] + 0.02234 * c[1] + c[2]};
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16. / 116; };
  const double x = f((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
  const double y = f(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
  const double z = f((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(Segment_colors_test, NeighboursLookDifferentWithAndWithoutConesForGreen) {
  const Mesh mesh = wavy_grid(60);
  std::mt19937 random(5);
  double smallest = 1000;
  for (int round = 0; round < 10; ++round) {
    // Blocks, of which random ones are joined to the left or to the one below.
    std::vector<std::size_t> parent(144), number(144, 144), segment;
    for (std::size_t i = 0; i < 144; ++i)
      parent[i] = random() % 3 == 0 && i % 12 > 0 ? parent[i - 1] : random() % 3 == 0 && i > 11 ? parent[i - 12] : i;
    std::size_t segments = 0;
    for (const std::size_t p : parent)
      if (number[p] == 144) number[p] = segments++;
    for (std::size_t f = 0; f < mesh.number_of_faces(); ++f)
      segment.push_back(number[parent[f / 60 / 5 * 12 + f % 60 / 5]]);
    const auto colors = segment_mesh::segment_colors(mesh, segment, segments);
    for (const auto& [a, b] : segment_mesh::neighbouring_segments(mesh, segment))
      for (const bool lacks_green : {false, true}) {
        const auto p = cielab(colors[a], lacks_green), q = cielab(colors[b], lacks_green);
        smallest = std::min(smallest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
  }
  EXPECT_GT(smallest, 10);  // 2 can just be seen
}

}  // namespace
