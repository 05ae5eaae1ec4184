// SPDX-License-Identifier: MIT

// Writes what fuzzing begins with: a folder for each target. For fuzz_mesh_files these are small sound files of all
// formats, for the others bytes of many lengths.
//
// Usage: write_corpus FOLDER TARGET ...

#include "../../examples/mesh_files.h"

#include "../gmsh_and_medit_files.h"
#include "../mesh_bytes.h"
#include "../meshes.h"
#include "../three_mf_files.h"
#include "../vtp_files.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

/// A shape in each format, behind the byte that chooses the reader.
std::vector<std::string> files_of(const meshes::Shape& shape) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const auto written = [&](char reader, const auto& writer) {
    std::ostringstream stream;
    stream << reader;
    writer(stream);
    return stream.str();
  };
  return {written('\0', [&](std::ostream& stream) { CGAL::IO::write_OFF(stream, mesh); }),
          written('\1', [&](std::ostream& stream) { CGAL::IO::write_PLY(stream, mesh); }),
          written('\1',
                  [&](std::ostream& stream) {
                    CGAL::IO::set_binary_mode(stream);
                    CGAL::IO::write_PLY(stream, mesh);
                  }),
          written('\2', [&](std::ostream& stream) { CGAL::IO::write_OBJ(stream, mesh); }),
          written('\3', [&](std::ostream& stream) { CGAL::IO::write_STL(stream, mesh); }),
          written('\3', [&](std::ostream& stream) {
            CGAL::IO::set_binary_mode(stream);
            CGAL::IO::write_STL(stream, mesh);
          })};
}

/// Dialects, behind the byte that chooses the reader.
std::vector<std::string> dialects() {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n",
                    facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 ";
  using namespace std::string_literals;
  return {
      "\0OFF3 1 3 0 0 0 1 0 0 0 1 0 3 0 1 2"s,
      "\0"
      "4OFF\n1 1 0\n1 2 3 4\n1 0\n"s,
      "\0nOFF\n3\n3 1 0\n"s + points + "3\n0 1\n2\n",
      "\1ply\rformat ascii 1.0\rby a program\relement vertex 3\rproperty float x\rproperty int64 y\rproperty float z\r"
      "element tristrips 1\rproperty list int int vertex_indices\rend_header\r"s +
          points + "8 0 1 2 0 -1 1 2 0\n",
      "\2\xef\xbb\xbfv 0 0 0\rv 1 0 0\r\nv 0 1 0\nfo 1 2 \\\n-1\n"s,
      "\3solid a b " + facet + "vertex 0 1 0 endloop endfacet endsolid",
      "\4 \n solid\n" + facet + "vertex 0 1 0\nendloop\nendfacet\n", "\4version https://git-lfs.github.com/spec/v1\n",
      "\4\xff\xfev\0 \0"s,
      // "OFF 0 0 0", packed by gzip.
      "\4\x1f\x8b\x08\0\0\0\0\0\x02\x03\xf3\x77\x73\x53\x30\0\x41\0\x41\xb0\x82\xbe\x09\0\0\0"s};
}

std::string random_bytes(unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes(std::size_t(16) << random() % 6, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 2; i < argc; ++i) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / argv[i];
    std::filesystem::create_directories(folder);
    std::size_t number = 0;
    const auto add = [&](const std::string& content) { write(folder / ("made_" + std::to_string(number++)), content); };
    if (std::string(argv[i]) == "fuzz_mesh_files") {
      for (const meshes::Shape& shape : {meshes::Shape(), meshes::plane(1), meshes::cube(1), meshes::sphere(1)})
        for (const std::string& file : files_of(shape)) add(file);
      for (const std::string& file : dialects()) add(file);
      for (const auto& [name, content] :
           gmsh_and_medit_files::all(mesh_bytes::tetrahedron_points, mesh_bytes::tetrahedron_faces))
        add((name.find(".msh") != std::string::npos ? "\5" : "\6") + content);
      for (const vtp_files::Form& form : vtp_files::all_forms())
        add("\7" + vtp_files::file(mesh_bytes::tetrahedron_points, mesh_bytes::tetrahedron_faces, form));
      const three_mf_files::Parts package = three_mf_files::package(
          three_mf_files::model("<object id=\"1\">" + three_mf_files::tetrahedron() +
                                    "</object><object id=\"2\" name=\"&lt;\"><components><component objectid=\"1\" "
                                    "transform=\"-1 0 0 0 1 0 0 0 "
                                    "1 1 2 3\"/></components></object>",
                                "<item objectid=\"2\"/><item objectid=\"1\"/>"));
      for (const three_mf_files::Form& form : three_mf_files::all_forms())
        add("\4" + three_mf_files::archive(package, form));
      add("\x0c" + package.back().second);
    } else {
      for (unsigned seed = 0; seed < 100; ++seed) add(random_bytes(seed));
    }
  }
}
