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
#include <deque>
#include <vector>

namespace RW_segmentation::internal::brep {

/// The shells of a mesh: one for each connected component.
///
/// A closed one is the outside of a solid; or, if it looks inward and lies in another one, a void in it. Those with a
/// border remain shells.
class Shell_nesting {
 public:
  explicit Shell_nesting(const std::deque<Shape_component>& components) {
    for (const Shape_component& component : components) shells_.emplace_back(component);
    BRep_Builder builder;
    std::vector<TopoDS_Shape> shapes;
    for (std::size_t i = 0; i < shells_.size(); ++i) {
      Shell& s = shells_[i];
      if (!s.is_closed) {
        ++open_shells_;
        shapes.push_back(s.shell);
        continue;
      }
      s.outside = s.volume < 0 ? smallest_around(i) : none;
      if (s.outside != none) continue;
      if (s.volume < 0) s.shell.Reverse();  // nothing is around it
      builder.MakeSolid(s.solid);
      builder.Add(s.solid, s.shell);
      ++solids_;
    }
    for (const Shell& s : shells_) {
      if (s.outside == none) continue;
      builder.Add(shells_[s.outside].solid, s.shell);
      ++voids_;
    }
    std::vector<TopoDS_Shape> solids;
    for (const Shell& s : shells_)
      if (!s.solid.IsNull()) solids.push_back(s.solid);
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
    return sum_over_solids([](const Shell& s) { return s.volume; });
  }
  /// Of the solids without their voids.
  double volume() const {
    return sum_over_solids([](const Shell& s) {
      double sum = 0;
      for (const Face_integrals& face : s.building.integrals()) sum += face.volume;
      return sum;
    });
  }

 private:
  struct Shell {
    const Halfedge_triangles& mesh;
    const Shape_building& building;
    bool is_closed = true;
    double volume = 0;           // signed; of closed ones
    std::size_t outside = none;  // the shell that this one is a void in
    TopoDS_Shell shell;
    TopoDS_Solid solid;

    explicit Shell(const Shape_component& component) : mesh(component.mesh), building(component.building) {
      for (std::size_t t = 0; t < mesh.number_of_triangles(); ++t)
        volume += (mesh.centre(t) - mesh.middle()).dot(mesh.area_vector(t)) / 3;
      for (std::size_t h = 0; h < mesh.number_of_halfedges(); ++h)
        if (mesh.opposite(h) == none) is_closed = false;
      BRep_Builder builder;
      builder.MakeShell(shell);
      for (const TopoDS_Face& face : building.faces())
        if (!face.IsNull()) builder.Add(shell, face);
      shell.Closed(BRep_Tool::IsClosed(shell));
    }
  };

  template <class Volume>
  double sum_over_solids(const Volume& volume) const {
    double sum = 0;
    for (const Shell& s : shells_)
      if (s.is_closed) sum += s.outside == none ? std::abs(volume(s)) : volume(s);
    return sum;
  }

  std::size_t smallest_around(std::size_t inner) const {
    const Point& p = shells_[inner].mesh.point(0);
    std::size_t smallest = none;
    for (std::size_t i = 0; i < shells_.size(); ++i) {
      const Shell& s = shells_[i];
      if (!s.is_closed || s.volume <= -shells_[inner].volume) continue;
      if ((smallest == none || s.volume < shells_[smallest].volume) && winds_round(s.mesh, p)) smallest = i;
    }
    return smallest;
  }

  /// Whether the triangles of a closed component fill the sphere round a point (van Oosterom and Strackee 1983).
  static bool winds_round(const Halfedge_triangles& mesh, const Point& p) {
    double half_angles = 0;
    for (std::size_t t = 0; t < mesh.number_of_triangles(); ++t) {
      const auto [i, j, k] = mesh.corners(t);
      const Point a = mesh.point(i) - p, b = mesh.point(j) - p, c = mesh.point(k) - p;
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

  std::vector<Shell> shells_;
  std::size_t solids_ = 0, voids_ = 0, open_shells_ = 0;
  TopoDS_Shape shape_;
};

}  // namespace RW_segmentation::internal::brep

#endif
