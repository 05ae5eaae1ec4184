// SPDX-License-Identifier: MIT

// How much memory reading a mesh file takes: a multiple of the file's size, whatever the file promises.

#include "../examples/mesh_files.h"

#include <gtest/gtest.h>
#include "counted_memory.h"
#include "three_mf_files.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  result.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

/// Repeated with a number in between, which counts from 1.
std::string numbered(const std::string& before, std::size_t times, const std::string& behind) {
  std::string result;
  for (std::size_t i = 1; i <= times; ++i) result += before + std::to_string(i) + behind;
  return result;
}

std::string ply(const std::string& format, std::size_t vertices, std::size_t faces, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty char x\nproperty char y\nproperty char z\nelement face " + std::to_string(faces) +
         "\nproperty list uchar uchar vertex_indices\nend_header\n" + rest;
}

std::string three_mf(const std::string& resources, const std::string& items) {
  return three_mf_files::archive({{"3D/3dmodel.model", three_mf_files::model(resources, items)}});
}

/// A part that promises far more than is packed in it.
std::string billions_of_bytes_in_3mf(std::size_t n) {
  three_mf_files::Form form;
  form.method = 8;
  std::string content = three_mf_files::archive({{"3D/3dmodel.model", std::string(n, ' ')}}, form);
  content.replace(content.find("PK\1\2") + 24, 4, "\xff\xff\xff\xee");
  return content;
}

/// The bytes that reading takes at most for each byte of the file.
double bytes_for_each(const std::string& name, const std::string& content) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / (std::to_string(std::random_device()()) + name);
  std::ofstream(path, std::ios::binary) << content;
  const std::string file = path.string();
  const std::size_t taken = counted_memory::peak_of([&] {
    try {
      mesh_files::read_mesh(file);
    } catch (const mesh_files::Unreadable_file&) {
    }
  });
  std::filesystem::remove(path);
  return static_cast<double>(taken) / static_cast<double>(content.size());
}

}  // namespace

TEST(Memory_of_files, IsAMultipleOfTheFileWhateverItPromises) {
  constexpr std::size_t n = 25000;
  const std::string stl_header(80, ' ');
  const std::vector<std::pair<std::string, std::string>> files = {
      // As many vertices or faces as there is room for, and all there are.
      {"vertices.off", "OFF\n" + std::to_string(n) + " 0 0\n" + repeated("0 0 0\n", n)},
      {"faces.off", "OFF\n0 " + std::to_string(n) + " 0\n" + repeated("0\n", n)},
      {"corners.off", "OFF\n1 1 0\n0 0 0\n" + std::to_string(n) + repeated(" 0", n) + "\n"},
      {"vertices.obj", repeated("v 0 0 0\n", n)},
      {"faces.obj", "v 0 0 0\n" + repeated("f\n", n)},
      {"corners.obj", "v 0 0 0\nf" + repeated(" 1", n)},
      {"text.ply", ply("ascii", n, n, repeated("0 0 0\n", n) + repeated("0\n", n))},
      {"vertices.ply", ply("binary_little_endian", n, 0, std::string(3 * n, '\0'))},
      {"faces.ply", ply("binary_big_endian", 0, n, std::string(n, '\0'))},
      {"strips.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
       "property char z\nelement tristrips 1\nproperty list int uchar vertex_indices\nend_header\n" +
           std::string(9, '\0') + std::string("\xf8\x24\1\0", 4) + repeated(std::string("\0\1\2", 3), n)},
      {"text.stl",
       "solid\n" + repeated("facet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", n) + "endsolid\n"},
      // As many as there is room for, and none there are.
      {"vertices_only_promised.off", "OFF\n" + std::to_string(n) + " 0 0\n" + std::string(5 * n, ' ')},
      {"faces_only_promised.off", "OFF\n0 " + std::to_string(n) + " 0\n" + std::string(2 * n, ' ')},
      {"only_promised.ply", ply("ascii", n, 0, std::string(6 * n, ' '))},
      // Billions.
      {"billions.off", "OFF\n4000000000 4000000000 0\n" + std::string(n, ' ')},
      {"billions.ply", ply("ascii", 4000000000, 4000000000, std::string(n, ' '))},
      {"billions_in_binary.ply", ply("binary_little_endian", 4000000000, 4000000000, std::string(n, '\0'))},
      {"billions.stl", stl_header + "\xff\xff\xff\xff" + std::string(n, '\0')},
      {"nodes.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(n) + "\n" +
                        repeated("1 0 0 0\n", n) + "$EndNodes\n"},
      {"nodes_4.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + std::to_string(n) + " 1 1\n2 1 0 " +
                          std::to_string(n) + "\n" + repeated("1\n", n) + repeated("0 0 0\n", n) + "$EndNodes\n"},
      {"billions.msh",
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 0 4000000000\n" + std::string(n, ' ')},
      {"vertices.mesh", "MeshVersionFormatted 2 Dimension 3 Vertices " + std::to_string(n) + repeated(" 0 0 0 0", n)},
      {"faces.mesh", "MeshVersionFormatted 2 Dimension 3 Triangles " + std::to_string(n) + repeated(" 1 1 1 0", n)},
      {"billions.mesh", "MeshVersionFormatted 2 Dimension 3 Vertices 4000000000 " + std::string(n, ' ')},
      {"billions.meshb", std::string("\1\0\0\0\2\0\0\0\4\0\0\0\0\0\0\0\xff\xff\xff\x7f", 20) + std::string(n, '\0')},
      {"points.vtp", "<VTKFile type='PolyData'><Piece NumberOfPoints='" + std::to_string(n) +
                         "'><Points><DataArray NumberOfComponents='3'>" + repeated("0 0 0 ", n) +
                         "</DataArray></Points></Piece></VTKFile>"},
      {"polygons.vtp", "<VTKFile type='PolyData'><Piece NumberOfPolys='" + std::to_string(n) +
                           "'><Polys><DataArray Name='connectivity'/><DataArray Name='offsets'>" + repeated("0 ", n) +
                           "</DataArray></Polys></Piece></VTKFile>"},
      {"empty_pieces.vtp", "<VTKFile type='PolyData'>" + repeated("<Piece/>", n) + "</VTKFile>"},
      {"pieces.vtp", "<VTKFile type='PolyData'>" + repeated("<Piece NumberOfPolys='1'/>", n) + "</VTKFile>"},
      {"attributes.vtp", "<VTKFile type='PolyData'><a " + repeated("b='' ", n) + "/></VTKFile>"},
      {"billions.vtp",
       "<VTKFile type='PolyData' compressor='vtkZLibDataCompressor'><Piece NumberOfPoints='4000000000'><Points>"
       "<DataArray type='Float32' NumberOfComponents='3' format='appended' offset='0'/></Points></Piece>"
       "<AppendedData encoding='raw'>_" +
           std::string("\1\0\0\0\xff\xff\xff\xff\0\0\0\0\xff\xff\1\0\x78\1", 18) + std::string(n, '\0') +
           "</AppendedData></VTKFile>"},
      {"vertices.3mf", three_mf("<object id='1'>" + repeated("<vertex x='0' y='0' z='0'/>", n) + "</object>", "")},
      {"triangles.3mf", three_mf("<object id='1'><vertex x='0' y='0' z='0'/>" +
                                     repeated("<triangle v1='0' v2='0' v3='0'/>", n) + "</object>",
                                 "<item objectid='1'/>")},
      {"objects.3mf", three_mf(numbered("<object id='", n, "'/>"), "")},
      {"items.3mf", three_mf("<object id='1'/>", repeated("<item objectid='1'/>", n))},
      {"files.3mf", three_mf_files::archive(three_mf_files::Parts(n / 2))},
      {"billions.3mf", billions_of_bytes_in_3mf(n)},
      {"billions_of_corners.off", "OFF\n1 1 0\n0 0 0\n4000000000" + repeated(" 0", n) + "\n"}};
  for (const auto& [name, content] : files) EXPECT_LT(bytes_for_each(name, content), 40) << name;
}
