// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_SEGMENTED_SOUP_H
#define MESH_FILES_SEGMENTED_SOUP_H

#include "Colors.h"
#include "Polygon_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mesh_files {

/// A mesh with a label for each face and a colour for each label, as it is written.
struct Segmented_soup {
  const Polygon_soup& soup;
  const std::vector<std::size_t>& face_labels;
  const std::map<std::size_t, Color>& color_of_label;
};

/// What a segment is called in files that have names.
inline std::string name_of_segment(std::size_t label) { return "segment_" + std::to_string(label); }

/// The faces of each label, in their order.
inline std::map<std::size_t, std::vector<std::size_t>> faces_of_labels(const std::vector<std::size_t>& face_labels) {
  std::map<std::size_t, std::vector<std::size_t>> faces;
  for (std::size_t f = 0; f < face_labels.size(); ++f) faces[face_labels[f]].push_back(f);
  return faces;
}

/// Cuts a polygon into triangles, which turn as it does: ears are cut off, seen from where the polygon looks largest. One
/// that has none left, such as one that crosses itself, and one of more than 10,000 corners become fans.
/// Complexity: O(n (r + 1)) for r corners that look inward.
class Ear_clipping {
 public:
  using Index = Polygon_soup::Index;

  explicit Ear_clipping(const std::vector<Polygon_soup::Point>& points) : points_(points) {}

  /// Calls `triangle(a, b, c)` for each triangle; a polygon of fewer than three corners has none.
  template <class Face, class Function>
  void operator()(const Face& face, const Function& triangle) {
    (*this)(face, triangle, [](Index, Index) { return true; });
  }

  /// The same without sides between corners that may not be joined, as far as there are other ways.
  template <class Face, class Function, class Predicate>
  void operator()(const Face& face, const Function& triangle, const Predicate& may_join) {
    constexpr std::size_t most_corners = 10000;
    begin(face);
    const auto may_cut = [&](std::size_t i) { return may_join(corners_[before_[i]], corners_[next_[i]]); };
    std::size_t left = corners_.size(), here = 0, passed = left > most_corners ? left : 0;
    for (; left > 3; --left) {
      for (; passed < left && !(is_ear(here) && may_cut(here)); ++passed) here = next_[here];
      if (passed == left)
        for (std::size_t tried = 0; tried < left && !may_cut(here); ++tried) here = next_[here];
      const std::size_t before = before_[here], after = next_[here];
      triangle(corners_[before], corners_[here], corners_[after]);
      next_[before] = after;
      before_[after] = before;
      inward_.erase(
          std::remove_if(inward_.begin(), inward_.end(), [&](std::size_t i) { return i == here || !looks_inward(i); }),
          inward_.end());
      if (passed < left) passed = 0;
      here = passed < left ? before : after;
    }
    if (left == 3) triangle(corners_[before_[here]], corners_[here], corners_[next_[here]]);
  }

 private:
  using Flat = std::array<double, 2>;

  template <class Face>
  void begin(const Face& face) {
    corners_.assign(face.begin(), face.end());
    project();
    const std::size_t size = corners_.size();
    before_.resize(size);
    next_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      before_[i] = (i + size - 1) % size;
      next_[i] = (i + 1) % size;
    }
    inward_.clear();
    for (std::size_t i = 0; i < size; ++i)
      if (looks_inward(i)) inward_.push_back(i);
  }

  /// Onto the coordinate plane in which the polygon has the largest area, counterclockwise.
  void project() {
    std::array<double, 3> normal = {0, 0, 0};
    const auto coordinate = [&](std::size_t i, std::size_t axis) {
      return points_[corners_[i]][static_cast<int>(axis)] - points_[corners_[0]][static_cast<int>(axis)];
    };
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t j = (i + 1) % corners_.size();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        normal[axis] += coordinate(i, u) * coordinate(j, v) - coordinate(i, v) * coordinate(j, u);
      }
    }
    std::size_t largest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (std::abs(normal[axis]) > std::abs(normal[largest])) largest = axis;
    const double sign = normal[largest] < 0 ? -1 : 1;
    flat_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i)
      flat_.push_back({sign * coordinate(i, (largest + 1) % 3), coordinate(i, (largest + 2) % 3)});
  }

  static double turn(const Flat& a, const Flat& b, const Flat& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  bool looks_inward(std::size_t i) const { return !(turn(flat_[before_[i]], flat_[i], flat_[next_[i]]) > 0); }

  bool is_ear(std::size_t i) const {
    if (looks_inward(i)) return false;
    const Flat &a = flat_[before_[i]], &b = flat_[i], &c = flat_[next_[i]];
    return std::none_of(inward_.begin(), inward_.end(), [&](std::size_t j) {
      return j != before_[i] && j != next_[i] && turn(a, b, flat_[j]) >= 0 && turn(b, c, flat_[j]) >= 0 &&
             turn(c, a, flat_[j]) >= 0;
    });
  }

  const std::vector<Polygon_soup::Point>& points_;
  std::vector<Index> corners_;
  std::vector<Flat> flat_;                  // their places in the plane
  std::vector<std::size_t> before_, next_;  // of those that are left
  std::vector<std::size_t> inward_;         // corners at which the polygon is not convex
};

/// The faces of a mesh with at most so many corners each, those with more cut into triangles; none has fewer than three.
struct Small_faces {
  Polygon_soup soup;               ///< with the points of the mesh
  std::vector<std::size_t> label;  ///< of each face
};

/// \param largest 3 or more
inline Small_faces small_faces(const Segmented_soup& mesh, std::size_t largest) {
  Small_faces result;
  result.soup.points = mesh.soup.points;
  Ear_clipping clip(mesh.soup.points);
  for (std::size_t f = 0; f < mesh.soup.number_of_faces(); ++f) {
    const auto face = mesh.soup.face(f);
    const auto add = [&](const auto& corners) {
      result.soup.corners.insert(result.soup.corners.end(), corners.begin(), corners.end());
      result.soup.end_face();
      result.label.push_back(mesh.face_labels[f]);
    };
    if (face.size() >= 3 && static_cast<std::size_t>(face.size()) <= largest)
      add(face);
    else
      clip(face, [&](auto a, auto b, auto c) { add(std::array{a, b, c}); });
  }
  return result;
}

}  // namespace mesh_files

#endif
