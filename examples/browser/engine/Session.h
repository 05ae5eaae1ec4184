// SPDX-License-Identifier: MIT

#ifndef BROWSER_ENGINE_SESSION_H
#define BROWSER_ENGINE_SESSION_H

#include "../../mesh_files/Output.h"
#include "../../mesh_files/Polygon_soup.h"
#include "../../mesh_files/write_mesh.h"
#include "../../segment_mesh/Method.h"
#include "../../segment_mesh/Oriented_mesh.h"
#include "../../segment_mesh/cut_polygons.h"
#include "../../segment_mesh/surfaces.h"
#include "../../segment_mesh/walls.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/regular_surfaces.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace browser_engine {

using segment_mesh::face_map;
using segment_mesh::Mesh;
using segment_mesh::Point;
using Label = std::uint32_t;
using Progress_callback = std::function<bool(double)>;

/// A mesh as it is drawn. Polygons are cut into triangles, those of each one after the other.
struct Drawn_mesh {
  std::vector<float> positions;                 ///< three of each vertex, from a corner of the mesh
  std::vector<std::uint32_t> triangles;         ///< three vertices each
  std::vector<std::uint32_t> face_of_triangle;  ///< which face each triangle shows
  std::vector<double> face_areas;
};

/// A segmentation at all levels, as a slider needs it.
struct Levels {
  std::vector<std::uint32_t> fragment_of_face;
  std::vector<std::uint32_t> merged_regions;  ///< two a merge
  std::vector<double> costs;                  ///< of the merges
  std::size_t fragments = 0, components = 0, suggested = 0;
  std::vector<std::uint32_t> offered;  ///< numbers of segments that people may prefer, that one among them
};

/// Curves on the surface, one after the other.
struct Polylines {
  std::vector<float> points;  ///< three coordinates each, from a corner of the mesh; a closed curve repeats its first
  std::vector<std::uint32_t> starts = {0};  ///< the first point of each curve, and the end of the last

  /// Makes a curve of the points added since the last one.
  void end_curve() { starts.push_back(static_cast<std::uint32_t>(points.size() / 3)); }
};

/// A file that is kept as its bytes.
class Kept_file final : public mesh_files::Output {
 public:
  explicit Kept_file(std::string name) : name_(std::move(name)) {}
  const std::string& path() const override { return name_; }
  void write(std::string_view bytes) override { bytes_ += bytes; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string name_, bytes_;
};

/// A mesh, its seeds and the walk on it, as a page edits them. Faces are named by their numbers in the mesh.
class Session {
 public:
  /// Repairs what the faces of a file need to be a surface.
  /// \throws std::invalid_argument if there is no face
  explicit Session(const mesh_files::Polygon_soup& soup)
      : points_of_file_(soup.points), input_(segment_mesh::oriented_mesh(soup, {})) {
    if (mesh().number_of_faces() == 0) throw std::invalid_argument("the file holds no face");
    origin_ = mesh().point(mesh().source(mesh().halfedge(*mesh().faces().begin())));
  }

  /// What was repaired, a sentence each.
  const std::vector<std::string>& remarks() const { return input_.remarks; }

  Drawn_mesh drawn_mesh() const {
    Drawn_mesh drawn;
    for (const auto v : mesh().vertices()) draw(mesh().point(v), drawn.positions);
    Mesh triangles = mesh();
    const std::vector<Mesh::Face_index> parent_of_new = segment_mesh::cut_polygons(triangles);
    const auto draw_triangle = [&](std::size_t triangle, Mesh::Face_index f) {
      const auto first = triangles.halfedge(Mesh::Face_index(static_cast<Mesh::size_type>(triangle)));
      for (const auto v : triangles.vertices_around_face(first)) drawn.triangles.push_back(v);
      drawn.face_of_triangle.push_back(f);
    };
    std::size_t next = 0;
    for (const auto f : mesh().faces()) {
      draw_triangle(f, f);
      for (; next < parent_of_new.size() && parent_of_new[next] == f; ++next)
        draw_triangle(mesh().number_of_faces() + next, f);
      drawn.face_areas.push_back(segment_mesh::face_area(mesh(), f, 1));
    }
    return drawn;
  }

  /// Makes walls, which nothing crosses, in place of those before. The walk heeds them once it is prepared.
  /// \param constraints edges, by the vertices of the file
  /// \param degrees edges are walls, too, over which the surface turns by more; without it none
  /// \returns the walls
  /// \throws std::invalid_argument if there is no such edge; the walls stay then
  Polylines set_walls(const std::vector<segment_mesh::Constraint>& constraints, std::optional<double> degrees) {
    const std::vector<bool> former(walls_.begin(), walls_.end());
    try {
      std::fill(walls_.begin(), walls_.end(), false);
      segment_mesh::mark_constraints(points_of_file_, constraints, mesh(), walls_);
      if (degrees) segment_mesh::mark_sharp_edges(mesh(), *degrees, walls_);
    } catch (...) {
      std::copy(former.begin(), former.end(), walls_.begin());
      throw;
    }
    Polylines lines;
    for (const auto e : mesh().edges()) {
      if (!walls_[e]) continue;
      for (const int end : {0, 1}) draw(mesh().point(mesh().vertex(e, end)), lines.points);
      lines.end_curve();
    }
    return lines;
  }

  /// Makes the walk anew for other numbers; the seeds stay.
  void prepare(double convex_weight, double sigma) {
    namespace RW = RW_segmentation;
    const RW::Dual_mesh_of dual(mesh(), CGAL::parameters::edge_is_constrained_map(walls_));
    const RW::Dual_mesh_of shape(dual.with_shape_normals_of(RW::smoothed_shape(dual)), dual);
    const RW::Dihedral_difference difference(shape, convex_weight, RW::Dihedral_measure::angle);
    Walk walk(dual, RW::Conductance(shape, difference, sigma));
    if (walk_)
      for (const auto& [face, label] : walk_->seeds()) walk.add_seed(face, label);
    walk_ = std::move(walk);
  }

  void add_seed(std::size_t face, Label label) { walk().add_seed(checked(face), label); }
  void remove_seed(std::size_t face) { walk().remove_seed(checked(face)); }
  void clear_seeds() { walk().clear_seeds(); }

  /// The label of each face.
  std::vector<Label> segment() {
    std::vector<Label> labels(mesh().number_of_faces());
    walk().segment(face_map(mesh(), labels));
    return labels;
  }

  /// Works ahead, so that the first seed of another label is answered as quickly as all that follow.
  void anticipate() { walk().anticipate(); }

  /// How probably a walk from each face meets a seed of the label first.
  std::vector<float> probabilities(Label label) {
    std::vector<float> result(mesh().number_of_faces());
    walk().write_probabilities(label, face_map(mesh(), result));
    return result;
  }

  /// Segments without seeds; of the solvers the page holds one.
  Levels levels(const segment_mesh::Method& method, const Progress_callback& callback) const {
    namespace RW = RW_segmentation;
    const auto policies = segment_mesh::policies_of(method).with_solver(RW::Star_mesh_elimination());
    return levels_of(RW::hierarchy_via_random_walks(
                         mesh(), policies, CGAL::parameters::callback(callback).edge_is_constrained_map(walls_)),
                     policies.stop);
  }

  /// Segments that are surfaces.
  Levels surface_levels(const Progress_callback& callback) const {
    const RW_segmentation::Surface_segmentation numbers;
    return levels_of(RW_segmentation::hierarchy_of_surfaces(
                         mesh(), numbers, CGAL::parameters::callback(callback).edge_is_constrained_map(walls_)),
                     [&](const RW_segmentation::Merge_tree& tree) { return numbers.stop(tree); });
  }

  /// The surfaces that segments lie on, as the report of the tool segment_mesh has them, and what was made regular.
  /// \param labels from 0 on
  /// \param regularity without it surfaces stay as they were fitted
  segment_mesh::Json surfaces(std::vector<Label> labels,
                              const std::optional<segment_mesh::Regular_option>& regularity) const {
    namespace RW = RW_segmentation;
    if (labels.size() != mesh().number_of_faces()) throw std::invalid_argument("a label for each face is needed");
    const RW::Dual_mesh_of dual(mesh(), CGAL::parameters::edge_is_constrained_map(walls_));
    const std::size_t segments = std::size_t(*std::max_element(labels.begin(), labels.end())) + 1;
    RW::Regular_surfaces result{RW::segment_surfaces(dual, face_map(mesh(), labels), segments), {}};
    if (regularity)
      result = RW::regular_surfaces(result.surfaces, segment_mesh::regularity_tolerance(*regularity, dual.unit()));
    return {{"surfaces", segment_mesh::surfaces_of(result.surfaces)},
            {"regular", segment_mesh::snaps_of(result.snaps)}};
  }

  /// The smooth boundaries between segments, on the triangles that are drawn.
  Polylines smooth_boundaries(std::vector<Label> labels) const {
    if (labels.size() != mesh().number_of_faces()) throw std::invalid_argument("a label for each face is needed");
    Mesh triangles = mesh();
    segment_mesh::inherit(labels, segment_mesh::cut_polygons(triangles));
    const auto walls = segment_mesh::wall_map(triangles);
    const auto curves = RW_segmentation::smooth_boundaries(triangles, face_map(triangles, labels),
                                                           CGAL::parameters::edge_is_constrained_map(walls));
    Polylines lines;
    for (const auto& curve : curves) {
      for (const auto& curve_point : curve.points) draw(curve_point.point, lines.points);
      if (curve.is_closed) draw(curve.points.front().point, lines.points);
      lines.end_curve();
    }
    return lines;
  }

  /// Writes the mesh with its segments, or of these alone what a format has of them, as the tool segment_mesh does.
  /// \param format one of the names of `--output-format`; "mtl", the materials of an OBJ file; or for the labels alone "seg",
  ///   "csv" or "npz"
  /// \param materials the name of the file with the materials of an OBJ file
  void write(const std::string& format, const std::string& materials, const std::vector<std::size_t>& labels,
             const std::map<std::size_t, mesh_files::Color>& color_of_label, Kept_file& file) const {
    if (labels.size() != mesh().number_of_faces()) throw std::invalid_argument("a label for each face is needed");
    if (format == "mtl") return mesh_files::write_materials(file, color_of_label);
    if (format == "seg" || format == "csv" || format == "npz")
      return mesh_files::write_labels_as("." + format, file, labels);
    const mesh_files::Output_format chosen = segment_mesh::choice_of(mesh_files::output_format_names, format);
    mesh_files::write_segments(file, chosen, {soup(), labels, color_of_label}, {false, materials});
  }

 private:
  using Walk = RW_segmentation::Random_walk<Mesh>;

  const Mesh& mesh() const { return input_.mesh; }

  /// Adds the coordinates of a point as they are drawn: single precision has no digits for a small mesh far away.
  void draw(const Point& point, std::vector<float>& coordinates) const {
    for (int i = 0; i < 3; ++i) coordinates.push_back(static_cast<float>(point[i] - origin_[i]));
  }

  mesh_files::Polygon_soup soup() const {
    mesh_files::Polygon_soup soup;
    for (const auto v : mesh().vertices()) soup.points.push_back(mesh().point(v));
    for (const auto f : mesh().faces()) {
      for (const auto v : mesh().vertices_around_face(mesh().halfedge(f))) soup.corners.push_back(v);
      soup.end_face();
    }
    return soup;
  }

  /// \param stop the level that the shape suggests
  Levels levels_of(const RW_segmentation::Segment_hierarchy<Mesh>& hierarchy,
                   const RW_segmentation::Any_stop& stop) const {
    Levels levels;
    levels.fragments = hierarchy.number_of_fragments();
    levels.components = hierarchy.number_of_components();
    levels.suggested = stop(hierarchy);
    for (const std::size_t level : hierarchy.levels(levels.suggested))
      levels.offered.push_back(static_cast<std::uint32_t>(level));
    levels.fragment_of_face.resize(mesh().number_of_faces());
    hierarchy.segments(RW_segmentation::Segment_count_stop(levels.fragments),
                       face_map(mesh(), levels.fragment_of_face));
    for (const auto& merge : hierarchy.merges()) {
      for (const std::size_t region : {merge.first, merge.second})
        levels.merged_regions.push_back(static_cast<std::uint32_t>(region));
      levels.costs.push_back(merge.cost);
    }
    return levels;
  }

  Walk& walk() {
    if (!walk_) throw std::logic_error("the walk has not been prepared");
    return *walk_;
  }

  Mesh::Face_index checked(std::size_t face) const {
    if (face >= mesh().number_of_faces()) throw std::invalid_argument("there is no face " + std::to_string(face));
    return Mesh::Face_index(static_cast<Mesh::size_type>(face));
  }

  std::vector<Point> points_of_file_;  // by which users name edges; repairs may number others
  segment_mesh::Oriented_mesh input_;
  segment_mesh::Wall_map walls_ = segment_mesh::wall_map(input_.mesh);
  std::optional<Walk> walk_;
  Point origin_;  // of what is drawn
};

}  // namespace browser_engine

#endif
