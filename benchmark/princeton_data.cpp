// SPDX-License-Identifier: MIT

#include "princeton_data.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

namespace princeton {

namespace {

#if __has_include(<CGAL/AABB_traits_3.h>)
template <class Kernel, class Primitive>
using AABB_traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
template <class Kernel, class Primitive>
using AABB_traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

Labels read_labels(const std::filesystem::path& path) {
  std::ifstream file(path);
  Labels labels;
  for (std::size_t label = 0; file >> label;) labels.push_back(label);
  if (!file.eof()) throw std::runtime_error(path.string() + ": not a label in each line");
  return labels;
}

std::vector<Labels> read_people(const std::filesystem::path& folder, std::size_t faces) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".seg") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Labels> people;
  for (const auto& path : paths) {
    people.push_back(read_labels(path));
    if (people.back().size() != faces)
      throw std::runtime_error(path.string() + ": " + std::to_string(people.back().size()) + " labels for " +
                               std::to_string(faces) + " faces");
  }
  if (people.empty()) throw std::runtime_error(folder.string() + ": no segmentations by people");
  return people;
}

void add_noise(Mesh& mesh, double percent, std::size_t random_seed) {
  std::mt19937 random(static_cast<unsigned>(random_seed));
  std::normal_distribution<double> noise;
  const double deviation = percent / 100 * diagonal_of(mesh);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    const double x = deviation * noise(random), y = deviation * noise(random), z = deviation * noise(random);
    mesh.point(v) = {p.x() + x, p.y() + y, p.z() + z};
  }
}

/// How many times each face is split in four, so that there are so many times as many.
int splits_in_four(double factor) {
  int splits = 0;
  double times = 1;
  for (; times < factor; times *= 4) ++splits;
  if (factor > 1 && times != factor)
    throw std::invalid_argument("the factor of faces must be a power of 4 or at most 1");
  return splits;
}

/// The mesh with each face split in four, and the middle ones of these.
std::pair<Mesh, std::vector<Face>> split_in_four(const Mesh& mesh) {
  Mesh fine;
  std::vector<Face> middle;
  std::vector<Mesh::Vertex_index> corner, halving;
  for (const auto v : mesh.vertices()) corner.push_back(fine.add_vertex(mesh.point(v)));
  for (const auto e : mesh.edges())
    halving.push_back(fine.add_vertex(CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)))));
  for (const auto f : mesh.faces()) {
    const auto a = mesh.halfedge(f), b = mesh.next(a), c = mesh.next(b);
    for (const auto& [in, out] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      fine.add_face(halving[mesh.edge(in)], corner[mesh.target(in)], halving[mesh.edge(out)]);
    middle.push_back(fine.add_face(halving[mesh.edge(a)], halving[mesh.edge(b)], halving[mesh.edge(c)]));
  }
  return {std::move(fine), std::move(middle)};
}

/// The mesh with a fraction of its faces, and for each face of `mesh` the one closest to its centroid.
std::pair<Mesh, std::vector<Face>> simplified(const Mesh& mesh, double ratio) {
  Mesh coarse = mesh;
  CGAL::Surface_mesh_simplification::edge_collapse(coarse, Edge_ratio_stop{ratio});
  coarse.collect_garbage();

  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  const CGAL::AABB_tree<AABB_traits<CGAL::Simple_cartesian<double>, Primitive>> tree(faces(coarse).begin(),
                                                                                     faces(coarse).end(), coarse);
  std::vector<Face> nearest;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto centroid =
        CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
    nearest.push_back(tree.closest_point_and_primitive(centroid).second);
  }
  return {std::move(coarse), std::move(nearest)};
}

}  // namespace

std::string category_of(std::size_t number) {
  static const std::vector<std::string> names = {
      "Human", "Cup",  "Glasses", "Airplane", "Ant",       "Chair", "Octopus", "Table",   "Teddy", "Hand",
      "Plier", "Fish", "Bird",    "Spring",   "Armadillo", "Bust",  "Mech",    "Bearing", "Vase",  "Fourleg"};
  return number >= 1 && number <= meshes_of_a_category * names.size() ? names[(number - 1) / meshes_of_a_category]
                                                                      : "others";
}

std::vector<std::size_t> numbers_in_folder(const std::filesystem::path& folder) {
  std::vector<std::size_t> numbers;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".off") numbers.push_back(std::stoul(entry.path().stem().string()));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<std::size_t> numbers_in_file(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::size_t> numbers;
  for (std::size_t number = 0; file >> number;) numbers.push_back(number);
  if (numbers.empty()) throw std::runtime_error(path + ": no numbers of meshes");
  return numbers;
}

double diagonal_of(const Mesh& mesh) {
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

Subject read_subject(const std::filesystem::path& data, std::size_t number, const Changes& changes) {
  const std::string name = std::to_string(number);
  Subject subject;
  subject.number = number;
  subject.mesh = measurement::read_mesh((data / "data" / "off" / (name + ".off")).string());
  subject.people = read_people(data / "data" / "seg" / "Benchmark" / name, num_faces(subject.mesh));
  if (changes.faces < 1)
    std::tie(subject.mesh, subject.nearest) = simplified(subject.mesh, changes.faces);
  else
    subject.nearest.assign(faces(subject.mesh).begin(), faces(subject.mesh).end());
  for (int splits = splits_in_four(changes.faces); splits > 0; --splits) {
    auto [fine, middle] = split_in_four(subject.mesh);
    for (Face& f : subject.nearest) f = middle[f];
    subject.mesh = std::move(fine);
  }
  if (changes.noise > 0) add_noise(subject.mesh, changes.noise, number);
  return subject;
}

}  // namespace princeton
