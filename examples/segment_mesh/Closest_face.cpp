// SPDX-License-Identifier: MIT

// Uses AABB_tree of CGAL, which is under the GPL.

#include "Closest_face.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

namespace segment_mesh {

/// A tree over the triangles of the faces.
class Closest_face::Tree {
 public:
  explicit Tree(const Mesh& mesh) {
    for (const auto f : mesh.faces()) {
      const auto first = halfedge(f, mesh);
      const Point& apex = mesh.point(source(first, mesh));
      for (auto h = next(first, mesh); target(h, mesh) != source(first, mesh); h = next(h, mesh)) {
        triangles_.emplace_back(apex, mesh.point(source(h, mesh)), mesh.point(target(h, mesh)));
        face_.push_back(f);
      }
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  // The tree points into the triangles.
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  Mesh::Face_index operator()(const Point& p) const {
    const auto [closest, found] = tree_.closest_point_and_primitive(p);
    const double distance = std::sqrt(CGAL::squared_distance(p, closest)) * (1 + 1e-12);
    std::vector<Primitive::Id> near;
    tree_.all_intersected_primitives(p.bbox() + CGAL::Bbox_3(p.x() - distance, p.y() - distance, p.z() - distance,
                                                             p.x() + distance, p.y() + distance, p.z() + distance),
                                     std::back_inserter(near));
    double smallest = CGAL::squared_distance(p, *found);
    Mesh::Face_index first = face_of(found);
    for (const auto triangle : near) {
      const double d = CGAL::squared_distance(p, *triangle);
      if (d > smallest || (d == smallest && first < face_of(triangle))) continue;
      smallest = d;
      first = face_of(triangle);
    }
    return first;
  }

 private:
  using Kernel = CGAL::Kernel_traits<Point>::Kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
#if CGAL_VERSION_NR >= 1060000000
  using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
  using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

  Mesh::Face_index face_of(Primitive::Id triangle) const {
    return face_[static_cast<std::size_t>(triangle - triangles_.begin())];
  }

  Triangles triangles_;
  std::vector<Mesh::Face_index> face_;  // of each triangle
  CGAL::AABB_tree<Traits> tree_;
};

Closest_face::Closest_face(const Mesh& mesh) : tree_(std::make_unique<const Tree>(mesh)) {}
Closest_face::~Closest_face() = default;

Mesh::Face_index Closest_face::operator()(const Point& p) const { return (*tree_)(p); }

}  // namespace segment_mesh
