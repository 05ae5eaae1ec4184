// SPDX-License-Identifier: MIT

// Writes what fuzzing begins with: a folder for each target. For fuzz_mesh_files these are small sound files of all
// formats, for the others bytes of many lengths.
//
// Usage: write_corpus FOLDER TARGET ...

#include "../../examples/mesh_files.h"

#include "../meshes.h"

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
    } else {
      for (unsigned seed = 0; seed < 100; ++seed) add(random_bytes(seed));
    }
  }
}
