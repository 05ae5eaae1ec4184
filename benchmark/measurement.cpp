// SPDX-License-Identifier: MIT

#include "measurement.h"

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/subdivision_method_3.h>

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace measurement {

Mesh read_mesh(const std::string& path) {
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(path, mesh)) throw std::runtime_error(path + ": cannot be read as a mesh");
  return mesh;
}

std::string data_mesh([[maybe_unused]] const std::string& name) {
#ifdef RW_SEGMENTATION_DATA_DIR
  return RW_SEGMENTATION_DATA_DIR "/meshes/" + name;
#else
  throw std::runtime_error("CGAL's data meshes are not installed (libcgal-demo): name a mesh of your own");
#endif
}

namespace {

/// How a mesh of a given size is made of a hand of 2390 triangles: subdivisions in three, then Loop subdivisions in four.
struct Size {
  std::string name;
  unsigned int in_three, in_four;
};

const std::vector<Size>& all_sizes() {
  static const std::vector<Size> all = {{"10k", 0, 1},   {"40k", 0, 2},   {"160k", 0, 3},  {"640k", 0, 4},
                                        {"1000k", 3, 2}, {"2500k", 0, 5}, {"10000k", 0, 6}};
  return all;
}

}  // namespace

std::vector<std::string> sizes() {
  std::vector<std::string> names;
  for (const Size& size : all_sizes()) names.push_back(size.name);
  return names;
}

Mesh mesh_of_size(const std::string& name) {
  const auto size =
      std::find_if(all_sizes().begin(), all_sizes().end(), [&](const Size& known) { return known.name == name; });
  if (size == all_sizes().end()) throw std::invalid_argument("no size is called " + name);
  Mesh mesh = read_mesh(data_mesh("hand.off"));
  CGAL::Subdivision_method_3::Sqrt3_subdivision(mesh, CGAL::parameters::number_of_iterations(size->in_three));
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(size->in_four));
  return mesh;
}

std::vector<Mesh::Face_index> random_faces(const Mesh& mesh, std::size_t number) {
  if (number > mesh.number_of_faces())
    throw std::invalid_argument(std::to_string(number) + " seeds on " + std::to_string(mesh.number_of_faces()) +
                                " faces");
  std::mt19937 random(1);
  std::vector<Mesh::Face_index> faces(mesh.faces_begin(), mesh.faces_end());
  for (std::size_t i = 0; i < number; ++i) std::swap(faces[i], faces[i + random() % (faces.size() - i)]);
  faces.resize(number);
  return faces;
}

double milliseconds_to_read(const std::string& path) {
  const Outcome outcome = in_own_process([&] {
    const Stopwatch watch;
    read_mesh(path);
    return std::vector<double>{watch.milliseconds()};
  });
  if (!outcome.failure.empty()) throw std::runtime_error(outcome.failure);
  return outcome.numbers.front();
}

double milliseconds_to_read(const Mesh& mesh) {
  const auto path = std::filesystem::temp_directory_path() / ("benchmark_" + std::to_string(getpid()) + "_mesh.off");
  if (!CGAL::IO::write_polygon_mesh(path.string(), mesh, CGAL::parameters::stream_precision(17)))
    throw std::runtime_error(path.string() + ": cannot be written");
  const double time = milliseconds_to_read(path.string());
  std::filesystem::remove(path);
  return time;
}

}  // namespace measurement
