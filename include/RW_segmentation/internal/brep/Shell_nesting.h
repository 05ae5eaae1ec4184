// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SHELL_NESTING_H
#define RW_SEGMENTATION_INTERNAL_BREP_SHELL_NESTING_H

#include <RW_segmentation/internal/brep/Face_integrals.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>
#include <RW_segmentation/internal/brep/Shape_building.h>

#include <Eigen/Geometry>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// The shells of a mesh: one for each connected component.
///
/// A closed one is the outside of a solid; or, if it looks inward and lies in another one, a void in it. Those with a
/// border remain shells.
class Shell_nesting {
 public:
  Shell_nesting(const Halfedge_triangles& mesh, const Shape_building& building) : mesh_(mesh) {
    std::vector<std::size_t> all(mesh.number_of_triangles());
    std::iota(all.begin(), all.end(), std::size_t(0));
    for (auto& triangles : mesh.parts(all, std::vector<char>(all.size(), 0)))
      components_.push_back(component(std::move(triangles), building));
    BRep_Builder builder;
    std::vector<TopoDS_Shape> shapes;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      Component& c = components_[i];
      if (!c.is_closed) {
        ++open_shells_;
        shapes.push_back(c.shell);
        continue;
      }
      c.outside = c.volume < 0 ? smallest_around(i) : none;
      if (c.outside != none) continue;
      if (c.volume < 0) c.shell.Reverse();  // nothing is around it
      builder.MakeSolid(c.solid);
      builder.Add(c.solid, c.shell);
      ++solids_;
    }
    for (const Component& c : components_) {
      if (c.outside == none) continue;
      builder.Add(components_[c.outside].solid, c.shell);
      ++voids_;
    }
    std::vector<TopoDS_Shape> solids;
    for (const Component& c : components_)
      if (!c.solid.IsNull()) solids.push_back(c.solid);
    shapes.insert(shapes.end(), solids.begin(), solids.end());
    shape_ = joined(shapes);
  }

  /// A solid, a shell, or a compound of several of them.
  const TopoDS_Shape& shape() const { return shape_; }
  std::size_t solids() const { return solids_; }
  std::size_t voids() const { return voids_; }
  std::size_t open_shells() const { return open_shells_; }
  /// Of the mesh; voids are not counted in.
  double mesh_volume() const {
    return sum_over_solids([](const Component& c) { return c.volume; });
  }
  /// Of the solids without their voids.
  /// \param integrals by patch
  double volume(const std::vector<Face_integrals>& integrals) const {
    return sum_over_solids([&](const Component& c) {
      double sum = 0;
      for (const std::size_t patch : c.patches) sum += integrals[patch].volume;
      return sum;
    });
  }

 private:
  struct Component {
    std::vector<std::size_t> triangles;
    std::vector<std::size_t> patches;  // rising
    bool is_closed = true;
    double volume = 0;           // signed; of closed ones
    std::size_t outside = none;  // the component that this one is a void in
    TopoDS_Shell shell;
    TopoDS_Solid solid;
  };

  Component component(std::vector<std::size_t> triangles, const Shape_building& building) const {
    Component result;
    BRep_Builder builder;
    builder.MakeShell(result.shell);
    const Point origin = mesh_.centre(triangles[0]);
    std::vector<std::size_t>& patches = result.patches;
    for (const std::size_t t : triangles) {
      result.volume += (mesh_.centre(t) - origin).dot(mesh_.area_vector(t)) / 3;
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h)
        if (mesh_.opposite(h) == none) result.is_closed = false;
      patches.push_back(building.patch_of(t));
    }
    std::sort(patches.begin(), patches.end());
    patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    for (const std::size_t patch : patches)
      if (!building.faces()[patch].IsNull()) builder.Add(result.shell, building.faces()[patch]);
    result.shell.Closed(BRep_Tool::IsClosed(result.shell));
    result.triangles = std::move(triangles);
    return result;
  }

  template <class Volume>
  double sum_over_solids(const Volume& volume) const {
    double sum = 0;
    for (const Component& c : components_)
      if (c.is_closed) sum += c.outside == none ? std::abs(volume(c)) : volume(c);
    return sum;
  }

  std::size_t smallest_around(std::size_t inner) const {
    const Point p = mesh_.point(mesh_.corners(components_[inner].triangles[0])[0]);
    std::size_t smallest = none;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const Component& c = components_[i];
      if (!c.is_closed || c.volume <= -components_[inner].volume) continue;
      if ((smallest == none || c.volume < components_[smallest].volume) && winds_round(c, p)) smallest = i;
    }
    return smallest;
  }

  /// Whether the triangles of a closed component fill the sphere round a point (van Oosterom and Strackee 1983).
  bool winds_round(const Component& component, const Point& p) const {
    double half_angles = 0;
    for (const std::size_t t : component.triangles) {
      const auto [i, j, k] = mesh_.corners(t);
      const Point a = mesh_.point(i) - p, b = mesh_.point(j) - p, c = mesh_.point(k) - p;
      const double denominator =
          a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() + c.dot(a) * b.norm();
      half_angles += std::atan2(a.dot(b.cross(c)), denominator);
    }
    constexpr double half_of_half_a_sphere = full_turn / 2;  // 4 pi fill the sphere, and these are half angles
    return half_angles > half_of_half_a_sphere;
  }

  static TopoDS_Shape joined(const std::vector<TopoDS_Shape>& shapes) {
    if (shapes.size() == 1) return shapes[0];
    TopoDS_Compound compound;
    BRep_Builder builder;
    builder.MakeCompound(compound);
    for (const TopoDS_Shape& shape : shapes) builder.Add(compound, shape);
    return compound;
  }

  const Halfedge_triangles& mesh_;
  std::vector<Component> components_;
  std::size_t solids_ = 0, voids_ = 0, open_shells_ = 0;
  TopoDS_Shape shape_;
};

}  // namespace RW_segmentation::internal::brep

#endif
