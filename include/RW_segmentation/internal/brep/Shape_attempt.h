// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SHAPE_ATTEMPT_H
#define RW_SEGMENTATION_INTERNAL_BREP_SHAPE_ATTEMPT_H

#include <RW_segmentation/internal/brep/Curved_triangle.h>
#include <RW_segmentation/internal/brep/Edge_curve.h>
#include <RW_segmentation/internal/brep/Edge_parameters.h>
#include <RW_segmentation/internal/brep/Edge_points.h>
#include <RW_segmentation/internal/brep/Face_integrals.h>
#include <RW_segmentation/internal/brep/Height_field.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Patch_borders.h>
#include <RW_segmentation/internal/brep/Placed_surface.h>
#include <RW_segmentation/internal/brep/kernel_errors.h>

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Plane.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// A patch whose face cannot be made, and why.
struct Rejection {
  std::size_t patch;
  std::string reason;
  enum class Cause { edge_far_from_surface, face_not_valid, other } cause;
};

/// All that a face on a given surface depends on.
struct Face_border {
  std::vector<Point> points;
  std::vector<double> tolerances;  // of its edges and vertices, which other faces widen

  bool operator==(const Face_border& other) const { return points == other.points && tolerances == other.tolerances; }
};

/// What earlier attempts found, lest it be done again for what has not changed.
struct Earlier_attempts {
  struct Valid_face {
    Face_border border;
    Face_integrals integrals;
  };
  /// The vertices of a chain, what binds it on either side, and whether it is a chord.
  using Chain_on_surfaces = std::tuple<std::vector<std::size_t>, std::shared_ptr<const Patch_surface>,
                                       std::shared_ptr<const Patch_surface>, bool>;
  struct Curve_between {
    std::array<Point, 2> ends;
    Edge_curve curve;
  };
  using Curve_on_surface = std::pair<Handle(Geom_Curve), Handle(Geom_Surface)>;
  struct Laid_curve {
    Handle(Geom2d_Curve) parameters;
    double deviation = 0;
    std::array<Point, 2> ends;  // on the surface
  };

  std::map<std::shared_ptr<const Patch_surface>, Valid_face> faces;  // by their surfaces
  std::map<Chain_on_surfaces, Curve_between> curves;
  std::map<Curve_on_surface, Laid_curve> laid_curves;
};

/// The faces of patches, made once. They share their edges and vertices, so that they are as closed as the mesh.
///
/// All is put together by `BRep_Builder`: nothing else leaves shared edges as they are. Tolerances are the distances that
/// are measured between vertices, edges and surfaces.
class Shape_attempt {
 public:
  /// \param earlier added to
  Shape_attempt(const Halfedge_triangles& mesh, const std::vector<Patch>& patches, Earlier_attempts& earlier)
      : mesh_(mesh), patches_(patches), borders_(mesh, patches), points_(mesh, patches, borders_), earlier_(earlier) {
    make_vertices();
    make_edges();
    if (rejections_.empty()) sample_borders();
    if (rejections_.empty()) fit_free_forms();
    if (rejections_.empty()) lay_edges_on_surfaces();
    if (rejections_.empty()) make_faces();
  }

  /// None if all went well.
  const std::vector<Rejection>& rejections() const { return rejections_; }
  /// By patch.
  const std::vector<TopoDS_Face>& faces() const { return faces_; }
  /// By patch; cones are from the middle of the mesh.
  const std::vector<Face_integrals>& integrals() const { return integrals_; }
  const Patch_borders& borders() const { return borders_; }
  /// By patch: the largest of the edges round it.
  std::vector<double> tolerances() const {
    std::vector<double> largest(patches_.size(), least_tolerance);
    for (std::size_t c = 0; c < edges_.size(); ++c)
      for (const std::size_t patch : {borders_.chains()[c].left, borders_.chains()[c].right})
        if (patch != none) largest[patch] = std::max(largest[patch], edges_[c].tolerance);
    return largest;
  }

 private:
  static constexpr double least_tolerance = 1e-7;  // of the kernel
  /// Of the diagonal: edges that are farther from a surface make another shape of it.
  static constexpr double largest_gap = 2e-3, largest_gap_of_chord = 2e-2;
  /// A face inside out has the area of all the rest; but a third of a circle may stand for a single chord of it.
  static constexpr double largest_error_of_area = 0.6;
  /// Of the diagonal: what a free form is to keep to, where its splines can.
  static constexpr double accuracy_of_free_form = 1e-5;

  struct Edge {
    Edge_curve curve;
    TopoDS_Edge edge;
    double tolerance = least_tolerance;
  };

  void reject(std::size_t patch, std::string reason, Rejection::Cause cause = Rejection::Cause::other) {
    if (patch != none) rejections_.push_back({patch, std::move(reason), cause});
  }

  void make_vertices() {
    vertices_.resize(mesh_.points().size());
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      if (borders_.is_branch(v))
        BRep_Builder().MakeVertex(vertices_[v], kernel_point(points_.position(v)), least_tolerance);
  }

  /// Lets a vertex reach a point.
  static void widen(const TopoDS_Vertex& vertex, const Point& p) {
    const double distance = BRep_Tool::Pnt(vertex).Distance(kernel_point(p));
    BRep_Builder().UpdateVertex(vertex, 1.001 * distance + least_tolerance);
  }

  void make_edges() {
    edges_.resize(borders_.chains().size());
    for (std::size_t c = 0; c < edges_.size(); ++c) {
      const Chain& chain = borders_.chains()[c];
      try {
        make_edge(chain, edges_[c]);
      } catch (const Standard_Failure& error) {
        for (const std::size_t patch : {chain.left, chain.right}) reject(patch, error.GetMessageString());
      }
    }
  }

  bool has_chords(std::size_t patch) const { return patch != none && patches_[patch].has_chords(); }

  void make_edge(const Chain& chain, Edge& edge) {
    edge.curve = curve_of(chain);
    const TopoDS_Vertex &first = vertices_[chain.vertices.front()], &last = vertices_[chain.vertices.back()];
    BRep_Builder builder;
    builder.MakeEdge(edge.edge, edge.curve.curve, least_tolerance);
    builder.Add(edge.edge, first.Oriented(TopAbs_FORWARD));
    builder.Add(edge.edge, last.Oriented(TopAbs_REVERSED));
    builder.Range(edge.edge, edge.curve.first, edge.curve.last);
    builder.SameParameter(edge.edge, true);
    builder.SameRange(edge.edge, true);
    widen(first, edge.curve.at_share(0));
    widen(last, edge.curve.at_share(1));
  }

  /// Whether a chain is the straight line between its ends.
  bool is_chord(const Chain& chain) const { return has_chords(chain.left) || has_chords(chain.right); }

  /// \throws Standard_Failure if there is no such curve
  const Edge_curve& curve_of(const Chain& chain) {
    const std::array<Point, 2> ends = {points_.position(chain.vertices.front()),
                                       points_.position(chain.vertices.back())};
    Earlier_attempts::Chain_on_surfaces place(chain.vertices, points_.binding(chain.left), points_.binding(chain.right),
                                              is_chord(chain));
    const auto known = earlier_.curves.find(place);
    if (known != earlier_.curves.end() && known->second.ends == ends) return known->second.curve;
    const Edge_curve curve =
        is_chord(chain) ? segment_between(ends[0], ends[1]) : curve_through(points_.points_of(chain), mesh_.diagonal());
    Earlier_attempts::Curve_between& found = earlier_.curves[std::move(place)];
    found = {ends, curve};
    return found.curve;
  }

  void sample_borders() {
    border_points_.resize(patches_.size());
    for (std::size_t c = 0; c < edges_.size(); ++c) {
      const Chain& chain = borders_.chains()[c];
      const std::size_t steps = std::clamp<std::size_t>(2 * chain.vertices.size(), 8, 200);
      for (std::size_t i = 0; i <= steps; ++i) {
        const Point p = edges_[c].curve.at_share(double(i) / double(steps));
        for (const std::size_t patch : {chain.left, chain.right})
          if (patch != none) border_points_[patch].push_back(p);
      }
    }
  }

  /// Surfaces of free forms pass through the vertices inside a patch and along its edges.
  void fit_free_forms() {
    std::vector<char> is_on_border(mesh_.points().size(), false);
    for (const Chain& chain : borders_.chains())
      for (const std::size_t v : chain.vertices) is_on_border[v] = true;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      auto* const field = dynamic_cast<Height_field*>(patches_[i].surface.get());
      if (!field) continue;
      std::vector<Point> points = border_points_[i];
      for (const std::size_t v : corners_of(mesh_, patches_[i].triangles))
        if (!is_on_border[v]) points.push_back(mesh_.point(v));
      const double deviation =
          field->fit(points, points_between_vertices(mesh_, patches_[i].triangles, Height_field::most_spans),
                     accuracy_of_free_form * mesh_.diagonal());
      if (!(deviation < largest_gap * mesh_.diagonal())) reject(i, "no free form comes close to the mesh");
    }
  }

  void lay_edges_on_surfaces() {
    for (std::size_t c = 0; c < edges_.size(); ++c) {
      const Chain& chain = borders_.chains()[c];
      for (const std::size_t patch : {chain.left, chain.right}) {
        if (patch == none || patches_[patch].has_triangles()) continue;
        try {
          const double gap = lay_on_surface(edges_[c], chain, *patches_[patch].surface);
          if (!(gap < (is_chord(chain) ? largest_gap_of_chord : largest_gap) * mesh_.diagonal()))
            reject(patch, "an edge is far from its surface", Rejection::Cause::edge_far_from_surface);
        } catch (const Standard_Failure& error) {
          reject(patch, error.GetMessageString(), Rejection::Cause::face_not_valid);
        }
      }
    }
    for (std::size_t c = 0; c < edges_.size(); ++c) {
      BRep_Builder builder;
      builder.UpdateEdge(edges_[c].edge, edges_[c].tolerance);
      const auto& vertices = borders_.chains()[c].vertices;
      for (const std::size_t v : {vertices.front(), vertices.back()})
        builder.UpdateVertex(vertices_[v], edges_[c].tolerance);
    }
  }

  /// \returns how far the edge is from the surface
  double lay_on_surface(Edge& edge, const Chain& chain, const Patch_surface& surface) {
    const Earlier_attempts::Laid_curve& laid = laid_curve(edge.curve, surface);
    BRep_Builder builder;
    builder.UpdateEdge(edge.edge, laid.parameters, surface.geometry(), TopLoc_Location(), least_tolerance);
    builder.Range(edge.edge, edge.curve.first, edge.curve.last);
    edge.tolerance = std::max(edge.tolerance, 1.05 * laid.deviation + least_tolerance);
    widen(vertices_[chain.vertices.front()], laid.ends[0]);
    widen(vertices_[chain.vertices.back()], laid.ends[1]);
    return laid.deviation;
  }

  const Earlier_attempts::Laid_curve& laid_curve(const Edge_curve& curve, const Patch_surface& surface) {
    Earlier_attempts::Laid_curve& laid = earlier_.laid_curves[{curve.curve, surface.geometry()}];
    if (!laid.parameters.IsNull()) return laid;
    const Edge_parameters parameters(curve, surface, mesh_.diagonal());
    laid = {parameters.curve(),
            parameters.deviation(),
            {parameters.on_surface(curve.first), parameters.on_surface(curve.last)}};
    return laid;
  }

  void make_faces() {
    faces_.resize(patches_.size());
    integrals_.resize(patches_.size());
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      try {
        faces_[i] = make_face(i);
        check_face(i);
      } catch (const Standard_Failure& error) {
        reject(i, error.GetMessageString(), Rejection::Cause::face_not_valid);
      }
    }
  }

  void check_face(std::size_t i) {
    const Patch& patch = patches_[i];
    if (patch.has_triangles()) {
      integrals_[i] = integrals_of(faces_[i], mesh_.middle());
      return;
    }
    Face_border border = {border_points_[i], tolerances_round(i)};
    const auto known = earlier_.faces.find(patch.surface);
    if (known != earlier_.faces.end() && known->second.border == border) {
      integrals_[i] = known->second.integrals;
      return;
    }
    if (std::string error = first_error(faces_[i]); !error.empty())
      return reject(i, std::move(error), Rejection::Cause::face_not_valid);
    integrals_[i] = integrals_of(faces_[i], mesh_.middle());
    const double area = area_of(mesh_, patch.triangles);
    const double least_area = 1e-6 * mesh_.diagonal() * mesh_.diagonal();
    if (!(std::abs(integrals_[i].area - area) <= largest_error_of_area * area + least_area))
      reject(i, "its area is not that of its triangles");
    else
      earlier_.faces[patch.surface] = {std::move(border), integrals_[i]};
  }

  std::vector<double> tolerances_round(std::size_t patch) const {
    std::vector<double> tolerances;
    for (const auto& loop : borders_.loops(patch))
      for (const auto& [chain, is_forward] : loop) {
        tolerances.push_back(edges_[chain].tolerance);
        for (const std::size_t end :
             {borders_.chains()[chain].vertices.front(), borders_.chains()[chain].vertices.back()})
          tolerances.push_back(BRep_Tool::Tolerance(vertices_[end]));
      }
    return tolerances;
  }

  /// Whether the normal of a patch's surface points out of the mesh.
  bool is_outward(const Patch& patch) const {
    double sum = 0;
    for (const std::size_t t : patch.triangles) sum += patch.surface->normal(mesh_.centre(t)).dot(mesh_.area_vector(t));
    return sum > 0;
  }

  /// \throws Standard_Failure if the triangle has no area
  Handle(Geom_Surface) plane_of_triangle(std::size_t t) const {
    const auto [a, b, c] = mesh_.corners(t);
    const Point p = points_.position(a);
    const Point normal = (points_.position(b) - p).cross(points_.position(c) - p);
    if (!(normal.norm() > 1e-14 * mesh_.diagonal() * mesh_.diagonal())) throw Standard_Failure("triangle of no area");
    return new Geom_Plane(kernel_point(p), kernel_direction(normal));
  }

  TopoDS_Face make_face(std::size_t i) {
    const Patch& patch = patches_[i];
    const bool outward = patch.has_triangles() || is_outward(patch);
    BRep_Builder builder;
    TopoDS_Face face;
    builder.MakeFace(face, patch.has_triangles() ? plane_of_triangle(patch.triangles[0]) : patch.surface->geometry(),
                     least_tolerance);
    for (const auto& loop : borders_.loops(i)) builder.Add(face, make_wire(patch, loop, outward));
    if (!outward) face.Reverse();
    return face;
  }

  TopoDS_Wire make_wire(const Patch& patch, const std::vector<Directed_chain>& loop, bool outward) {
    std::vector<TopoDS_Edge> edges;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto [chain, is_forward] = loop[k];
      const TopAbs_Orientation orientation = is_forward == outward ? TopAbs_FORWARD : TopAbs_REVERSED;
      edges.push_back(TopoDS::Edge(edges_[chain].edge.Oriented(orientation)));
      const auto& vertices = borders_.chains()[chain].vertices;
      const std::size_t end = is_forward ? vertices.back() : vertices.front();
      if (patch.surface && patch.surface->is_tip(points_.position(end)))
        edges.push_back(edge_at_tip(static_cast<const Placed_surface&>(*patch.surface), end, chain,
                                    loop[(k + 1) % loop.size()].chain, outward));
    }
    if (!outward) std::reverse(edges.begin(), edges.end());
    BRep_Builder builder;
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    for (const TopoDS_Edge& edge : edges) builder.Add(wire, edge);
    wire.Closed(true);
    return wire;
  }

  /// The edge without length at the tip of a cone, between two chains.
  TopoDS_Edge edge_at_tip(const Placed_surface& surface, std::size_t tip, std::size_t chain, std::size_t next_chain,
                          bool outward) {
    double u = surface.parameters(edges_[chain].curve.at_share(0.5))[0];
    double next_u = surface.parameters(edges_[next_chain].curve.at_share(0.5))[0];
    if (!outward) std::swap(u, next_u);
    BRep_Builder builder;
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, straight_parameters({u, surface.tip_parameter()}, {next_u, surface.tip_parameter()}, 0, 1),
                       surface.geometry(), TopLoc_Location(), least_tolerance);
    builder.Add(edge, vertices_[tip].Oriented(TopAbs_FORWARD));
    builder.Add(edge, vertices_[tip].Oriented(TopAbs_REVERSED));
    builder.Range(edge, 0, 1);
    builder.Degenerated(edge, true);
    return edge;
  }

  const Halfedge_triangles& mesh_;
  const std::vector<Patch>& patches_;
  Patch_borders borders_;
  Edge_points points_;
  std::vector<TopoDS_Vertex> vertices_;            // by mesh vertex; null unless it is a branch point
  std::vector<Edge> edges_;                        // by chain
  std::vector<TopoDS_Face> faces_;                 // by patch
  std::vector<Face_integrals> integrals_;          // by patch
  std::vector<std::vector<Point>> border_points_;  // by patch
  Earlier_attempts& earlier_;
  std::vector<Rejection> rejections_;
};

}  // namespace RW_segmentation::internal::brep

#endif
