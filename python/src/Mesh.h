// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_MESH_H
#define RW_PYTHON_MESH_H

#include "Array_mesh.h"
#include "arrays.h"
#include "read_mesh.h"

#include <RW_segmentation/Dual_mesh.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rw_python {

namespace RW = RW_segmentation;

/// The mesh as the library sees it.
using Dual = RW::Dual_mesh_of<Array_mesh>;

/// A mesh over arrays of numpy's, which it keeps alive.
class Mesh {
 public:
  using Any_array = nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>;

  /// \param vertices three float32 or float64 a row
  /// \param corners vertices of the faces, 32 or 64 bits wide, all in one row
  /// \param offsets int64: where each face begins in it, and the end of the last; without them all faces have `degree`
  /// \throws std::invalid_argument, see `read_mesh()`
  Mesh(Any_array vertices, Any_array corners, std::optional<Integers> offsets, std::size_t degree, bool is_repaired);

  // What is computed refers to the mesh.
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  const Array_mesh& halfedges() const { return read_.mesh; }
  std::size_t number_of_faces() const { return polygons_.number_of_faces; }
  const std::vector<std::string>& remarks() const { return read_.remarks; }
  /// The user's faces in the order of the mesh; empty: all of them.
  std::vector<std::int64_t> user_faces() const;

  /// The face of the mesh for one of the user's.
  /// \param role what the face is called in the error
  /// \throws std::invalid_argument if there is none
  Face face(std::int64_t number, const std::string& role) const;

  /// The same, nothing where the face was left out.
  std::optional<Face> known_face(std::size_t number) const {
    const std::size_t place = read_.mesh_face.empty() ? number : read_.mesh_face[number];
    return place == none ? std::nullopt : std::optional<Face>(place);
  }

  /// The vertex at a corner of one of the user's faces.
  std::size_t corner(std::int64_t face, std::size_t place) const;

  /// Values by face of the mesh, by the user's faces: where one was left out, that of the closest.
  template <class To, class From>
  std::vector<To> by_user_face(const std::vector<From>& values, std::size_t columns = 1) const {
    if (speaker_.empty()) return std::vector<To>(values.begin(), values.end());
    std::vector<To> result;
    result.reserve(speaker_.size() * columns);
    for (const Index f : speaker_)
      for (std::size_t k = 0; k < columns; ++k) result.push_back(static_cast<To>(values[f * columns + k]));
    return result;
  }

  /// The user's values by face of the mesh.
  template <class To, class From>
  std::vector<To> by_mesh_face(const From* values) const {
    std::vector<To> result(halfedges().number_of_faces());
    for (std::size_t f = 0; f < number_of_faces(); ++f) {
      const std::size_t place = read_.mesh_face.empty() ? f : read_.mesh_face[f];
      if (place != none) result[place] = static_cast<To>(values[f]);
    }
    return result;
  }

  /// The interior edges in their order, those between two different faces.
  std::vector<Edge> interior_edges() const;

  /// Whether each edge of the mesh is among pairs of vertices, by the places of these; empty if there are no pairs.
  /// \throws std::invalid_argument if no edge joins the two
  std::vector<char> walls(const std::optional<Pairs>& pairs) const;

  /// Reads the mesh for the library.
  Dual dual(const std::optional<Pairs>& walls = {}) const;

  /// Values by interior edge, by edge of the mesh; 0 on the border.
  /// \throws std::invalid_argument if there are not as many as interior edges
  std::vector<double> by_edge(const Numbers& values, const char* argument) const;

 private:
  void find_closest_of_left_out();

  Any_array vertices_, corners_;
  std::optional<Integers> offsets_;
  Polygons polygons_;
  Read_mesh read_;
  std::vector<Index> speaker_;  ///< of each of the user's faces a face of the mesh; empty: all as they are
};

/// Values by edge of the dual mesh, by interior edge.
std::vector<double> by_interior_edge(const Mesh& mesh, const Dual& dual, const std::vector<double>& values);

}  // namespace rw_python

#endif
