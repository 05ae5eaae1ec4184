// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_FUZZ_FUZZED_INPUT_H
#define RW_SEGMENTATION_TEST_FUZZ_FUZZED_INPUT_H

// What fuzz targets share: small meshes, labels and numbers, sound and unsound, made of the bytes of a fuzzer.

#include "../meshes.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <fuzzer/FuzzedDataProvider.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

namespace fuzz {

using Mesh = meshes::Surface_mesh;
/// Which edges nothing crosses.
using Walls = Mesh::Property_map<Mesh::Edge_index, bool>;

/// Ends the program, so that the fuzzer keeps the input.
inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", property);
  std::abort();
}

/// Runs a function that may refuse its input. Whether it did not.
template <class Function>
bool accepts(const Function& function) {
  try {
    function();
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  std::size_t below(std::size_t limit) { return bytes_.ConsumeIntegralInRange<std::size_t>(0, limit - 1); }
  bool flip() { return bytes_.ConsumeBool(); }

  /// A number of ordinary size now and then, otherwise one of many sizes, if wished not even finite.
  double number(bool is_finite = true) {
    switch (below(8)) {
      case 0:
        return 0;
      case 1:
        return 1;
      case 2:
        return std::pow(10., static_cast<double>(below(300)) - 150);
      case 3:
        return is_finite ? 2 : -1;
      case 4:
        return is_finite ? 3 : std::numeric_limits<double>::quiet_NaN();
      case 5:
        return is_finite ? 0.5 : std::numeric_limits<double>::infinity();
      default:
        return bytes_.ConsumeProbability<double>();
    }
  }

  /// A mesh of a few hundred faces at most that has seen better days: vertices moved onto others, onto edges and far
  /// off; faces removed, edges flipped and collapsed, faces split and joined.
  Mesh mesh(bool is_triangulated) {
    Mesh mesh = meshes::surface_mesh(shape());
    for (std::size_t n = below(8); n > 0; --n) move_a_vertex(mesh);
    for (std::size_t n = below(12); n > 0; --n) operate(mesh);
    if (!is_triangulated)
      for (std::size_t n = below(8); n > 0; --n) join_faces(mesh);
    if (flip()) mesh.collect_garbage();
    if (flip()) scale(mesh);
    return mesh;
  }

  /// A face of a mesh that has some.
  Mesh::Face_index face_of(const Mesh& mesh) { return *std::next(mesh.faces().begin(), place(mesh.number_of_faces())); }

  /// Walls, none or many.
  Walls walls(Mesh& mesh) {
    const Walls walls = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_wall", false).first;
    const std::size_t sixteenths = flip() ? below(16) : 0;
    if (sixteenths > 0)
      for (const auto e : mesh.edges()) walls[e] = below(16) < sixteenths;
    return walls;
  }

  /// Labels, each that of a neighbour if that has one, or any.
  std::vector<std::size_t> labels(const Mesh& mesh, std::size_t number) {
    std::vector<std::size_t> result(mesh.num_faces(), number);
    const bool is_patchy = flip();
    for (const auto f : mesh.faces()) {
      std::size_t label = below(number);
      if (is_patchy && below(16) > 0)
        for (const auto g : CGAL::faces_around_face(mesh.halfedge(f), mesh))
          if (g != Mesh::null_face() && result[g] < number) label = result[g];
      result[f] = label;
    }
    return result;
  }

 private:
  std::ptrdiff_t place(std::size_t size) { return static_cast<std::ptrdiff_t>(below(size)); }

  meshes::Shape shape() {
    switch (below(9)) {
      case 0:
        return {};
      case 1:
        return meshes::plane(1 + below(6));
      case 2:
        return meshes::cube(1 + below(4));
      case 3:
        return meshes::l_shape(1 + below(3));
      case 4:
        return meshes::sphere(below(3));
      case 5:
        return meshes::torus(1, 0.3, 3 + below(8), 3 + below(6));
      case 6:
        return meshes::tube(1, 3 + below(8), 1 + below(4));
      case 7:
        return meshes::folded_strip(static_cast<double>(below(9)) * meshes::pi / 8, 1 + below(4));
      default:
        return meshes::together(meshes::cube(1 + below(2)), meshes::moved(meshes::sphere(1), {3, 0, 0}));
    }
  }

  void move_a_vertex(Mesh& mesh) {
    if (mesh.number_of_vertices() == 0) return;
    const auto any = [&] { return mesh.point(*std::next(mesh.vertices().begin(), place(mesh.number_of_vertices()))); };
    auto& p = mesh.point(*std::next(mesh.vertices().begin(), place(mesh.number_of_vertices())));
    switch (below(4)) {
      case 0:
        p = any();
        break;
      case 1:
        p = CGAL::midpoint(any(), any());
        break;
      case 2:
        p = Mesh::Point(number(), number(), number());
        break;
      default:
        p = Mesh::Point(p.x() + 0.3 * bytes_.ConsumeProbability<double>(), p.y(), p.z());
    }
  }

  /// One Euler operation, if it is possible.
  void operate(Mesh& mesh) {
    if (mesh.number_of_faces() == 0) return;
    const auto e = *std::next(mesh.edges().begin(), place(mesh.number_of_edges()));
    const auto h = mesh.halfedge(e, static_cast<unsigned>(below(2)));
    switch (below(4)) {
      case 0:
        if (!mesh.is_border(h)) CGAL::Euler::remove_face(h, mesh);
        break;
      case 1:
        if (!mesh.is_border(e) &&
            mesh.halfedge(mesh.target(mesh.next(h)), mesh.target(mesh.next(mesh.opposite(h)))) == Mesh::null_halfedge())
          CGAL::Euler::flip_edge(h, mesh);
        break;
      case 2:
        if (CGAL::Euler::does_satisfy_link_condition(e, mesh)) CGAL::Euler::collapse_edge(e, mesh);
        break;
      default:
        if (!mesh.is_border(h)) {
          const auto centre = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(mesh.next(h))));
          mesh.point(mesh.target(CGAL::Euler::add_center_vertex(h, mesh))) = centre;
        }
    }
  }

  /// Makes one face of two that share an edge and nothing else.
  void join_faces(Mesh& mesh) {
    if (mesh.number_of_edges() == 0) return;
    const auto e = *std::next(mesh.edges().begin(), place(mesh.number_of_edges()));
    if (mesh.is_border(e)) return;
    const auto h = mesh.halfedge(e);
    std::size_t shared = 0;
    for (const auto v : CGAL::vertices_around_face(h, mesh))
      for (const auto w : CGAL::vertices_around_face(mesh.opposite(h), mesh)) shared += v == w;
    if (shared == 2 && mesh.degree(mesh.source(h)) > 2 && mesh.degree(mesh.target(h)) > 2)
      CGAL::Euler::join_face(h, mesh);
  }

  void scale(Mesh& mesh) {
    const double factor = std::pow(10., static_cast<double>(below(240)) - 120), offset = factor * number();
    for (const auto v : mesh.vertices()) {
      auto& p = mesh.point(v);
      p = Mesh::Point(factor * p.x() + offset, factor * p.y() + offset, factor * p.z() + offset);
    }
  }

  FuzzedDataProvider bytes_;
};

/// Whether each label's faces hang together, not over walls alone, and the labels are 0, 1, ...
inline bool are_connected_segments(const Mesh& mesh, const Walls& walls, const std::vector<std::size_t>& label,
                                   std::size_t segments) {
  std::vector<bool> is_met(segments, false), is_done(mesh.num_faces(), false);
  std::vector<Mesh::Face_index> front;
  for (const auto first : mesh.faces()) {
    if (is_done[first]) continue;
    if (label[first] >= segments || is_met[label[first]]) return false;
    is_met[label[first]] = is_done[first] = true;
    front.push_back(first);
    while (!front.empty()) {
      const auto f = front.back();
      front.pop_back();
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const auto g = mesh.face(mesh.opposite(h));
        if (g == Mesh::null_face() || walls[mesh.edge(h)] || is_done[g] || label[g] != label[f]) continue;
        is_done[g] = true;
        front.push_back(g);
      }
    }
  }
  return std::find(is_met.begin(), is_met.end(), false) == is_met.end();
}

}  // namespace fuzz

#endif
