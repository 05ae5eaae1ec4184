// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SPLIT_ALONG_BOUNDARIES_H
#define RW_SEGMENTATION_SPLIT_ALONG_BOUNDARIES_H

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Surface_refinement.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What `split_along_boundaries()` tells its visitor: nothing here; derive from it and redefine what you need. The names
/// are those of the visitors of CGAL's Polygon_mesh_processing.
template <class TriangleMesh>
struct Default_split_visitor {
  using vertex_descriptor = typename boost::graph_traits<TriangleMesh>::vertex_descriptor;
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  using face_descriptor = typename boost::graph_traits<TriangleMesh>::face_descriptor;

  /// An edge is about to be split, at this fraction of the way from the source of `h` as it is now.
  void before_edge_split(halfedge_descriptor /* h */, double /* position */, const TriangleMesh&) {}
  /// The edge has been split: the new halfedge ends at the new vertex and is followed by `h`.
  void edge_split(halfedge_descriptor /* new_halfedge */, const TriangleMesh&) {}
  /// A face is about to be divided.
  void before_subface_creations(face_descriptor /* face */, const TriangleMesh&) {}
  /// A new face is part of it, beside what is left of the face itself.
  void after_subface_created(face_descriptor /* new_face */, const TriangleMesh&) {}
  /// The face is divided into triangles, with their segments.
  void after_subface_creations(const TriangleMesh&) {}
};

/// What was done to a mesh.
struct Split_report {
  std::size_t vertices_added = 0;    ///< each on an old edge
  std::size_t faces_added = 0;       ///< beside the faces that were there
  std::size_t faces_divided = 0;     ///< of the faces that were there
  std::size_t faces_relabelled = 0;  ///< whole faces that came to lie on the other side of a boundary
};

namespace internal {

/// A point of a curve in numbers.
/// \param name of the curve
/// \throws std::invalid_argument if it is not on the mesh
template <class TriangleMesh, class Point>
Curve_node curve_node(const Boundary_point<TriangleMesh, Point>& point, const Dual_mesh_of<TriangleMesh>& mesh,
                      const Triangle_surface& surface, const std::string& name) {
  if (!(point.position >= 0 && point.position <= 1))
    throw argument_error(("a position on " + name).c_str(), point.position, "from 0 to 1");
  Triangle_surface::Index h = number_of_halfedge(point.halfedge, mesh);
  double position = point.position;
  if (h == Triangle_surface::none) {  // the side without a face
    h = number_of_halfedge(opposite(point.halfedge, mesh.mesh()), mesh);
    position = 1 - position;
  }
  if (h == Triangle_surface::none) throw std::invalid_argument("a point of " + name + " is on no face of the mesh");
  Curve_node node;
  if (position == 0 || position == 1) {
    node.vertex = position == 0 ? surface.source(h) : surface.target(h);
  } else {
    node.edge = surface.edge(h);
    node.position = node.edge == h ? position : 1 - position;
  }
  return node;
}

/// The curves in numbers.
/// \throws std::invalid_argument if a curve is none, or a point of it not on the mesh
template <class TriangleMesh, class Point>
std::vector<Surface_curve> surface_curves(const std::vector<Boundary_curve<TriangleMesh, Point>>& curves,
                                          const Dual_mesh_of<TriangleMesh>& mesh, const Triangle_surface& surface) {
  std::vector<Surface_curve> result;
  for (const auto& curve : curves) {
    const std::string name = "curve " + std::to_string(result.size());
    if (curve.points.size() < (curve.is_closed ? 3 : 2))
      throw argument_error(("the number of points of " + name).c_str(), curve.points.size(),
                           "at least 2, or 3 if it is closed");
    if (curve.segments[0] == curve.segments[1])
      throw argument_error(("the segment on the right of " + name).c_str(), curve.segments[1],
                           "another one than that on the left");
    result.push_back({{}, curve.is_closed, curve.segments, curve.is_smoothed, curve.joining});
    for (const auto& point : curve.points) result.back().nodes.push_back(curve_node(point, mesh, surface, name));
  }
  return result;
}

/// \throws std::invalid_argument that names the first curve at fault
inline void require_no_faults(const Surface_refinement& refinement) {
  if (!refinement.has_faults()) return;
  const auto& faulty = refinement.faulty_curves();
  const auto first = std::find(faulty.begin(), faulty.end(), true);
  if (first == faulty.end()) throw std::invalid_argument("the curves do not bound the segments of the mesh");
  throw std::invalid_argument("curve " + std::to_string(first - faulty.begin()) +
                              " crosses another one, cuts off too low a triangle, or does not bound its segments");
}

/// What is written while a mesh is cut.
template <class SegmentIdMap, class ConstrainedMap, class VertexPointMap>
struct Split_maps {
  SegmentIdMap segments;
  ConstrainedMap constrained;
  VertexPointMap points;
};

/// Carries a planned refinement out. Nothing in here can fail but the allocation of memory.
template <class TriangleMesh, class SegmentIdMap, class ConstrainedMap, class VertexPointMap, class Visitor>
class Refinement_step {
 public:
  using Index = Triangle_surface::Index;
  using Traits = boost::graph_traits<TriangleMesh>;
  using vertex_descriptor = typename Traits::vertex_descriptor;
  using halfedge_descriptor = typename Traits::halfedge_descriptor;
  using edge_descriptor = typename Traits::edge_descriptor;
  using Segment = typename boost::property_traits<SegmentIdMap>::value_type;
  using Point = typename boost::property_traits<VertexPointMap>::value_type;
  using Maps = Split_maps<SegmentIdMap, ConstrainedMap, VertexPointMap>;

  /// \param mesh what `dual` was read from
  Refinement_step(TriangleMesh& mesh, const Dual_mesh_of<TriangleMesh>& dual, const Surface_refinement& refinement,
                  const Maps& maps, Visitor& visitor)
      : mesh_(mesh),
        dual_(dual),
        surface_(refinement.surface()),
        refinement_(refinement),
        segments_(maps.segments),
        constrained_(maps.constrained),
        points_(maps.points),
        visitor_(visitor) {}

  Split_report operator()() {
    reserve_memory();
    relabel_whole_faces();
    for (const Index h : refinement_.whole_edges()) put(constrained_, edge(descriptor(h), mesh_), true);

    // Descriptors by number are good only as long as the faces are triangles.
    std::vector<vertex_descriptor> vertex_of(surface_.number_of_vertices());
    for (Index h = 0; h < surface_.number_of_halfedges(); ++h)
      vertex_of[surface_.source(h)] = source(descriptor(h), mesh_);
    std::vector<halfedge_descriptor> into_first_corner;
    for (const auto& cut : refinement_.cut_faces()) into_first_corner.push_back(descriptor(3 * cut.face + 2));
    split_edges(vertex_of);
    for (std::size_t i = 0; i < into_first_corner.size(); ++i) {
      const Surface_refinement::Cut_face& cut = refinement_.cut_faces()[i];
      halfedge_descriptor h = into_first_corner[i];
      while (target(h, mesh_) != vertex_of[cut.corners[0]]) h = next(h, mesh_);
      divide(cut, h);
    }
    return report_;
  }

 private:
  halfedge_descriptor descriptor(Index h) const { return descriptor_of_halfedge(h, dual_); }

  /// So that, where meshes can reserve, none is left in the middle of an operation.
  void reserve_memory() {
    const std::size_t vertices = refinement_.edge_cuts().size();
    std::size_t faces = 0;
    for (const auto& cut : refinement_.cut_faces()) faces += cut.corners.size() - 3;
    using Size = typename Traits::vertices_size_type;
    reserve(mesh_, static_cast<Size>(num_vertices(mesh_) + vertices),
            static_cast<Size>(num_edges(mesh_) + vertices + faces), static_cast<Size>(num_faces(mesh_) + faces));
  }

  void relabel_whole_faces() {
    std::vector<char> is_cut(surface_.number_of_faces(), false);
    for (const auto& cut : refinement_.cut_faces()) is_cut[cut.face] = true;
    for (Index f = 0; f < is_cut.size(); ++f) {
      const auto segment = static_cast<Segment>(refinement_.segment_of_face(f));
      if (is_cut[f] || get(segments_, dual_.face(f)) == segment) continue;
      put(segments_, dual_.face(f), segment);
      ++report_.faces_relabelled;
    }
  }

  /// Puts the new vertices behind those of the mesh.
  void split_edges(std::vector<vertex_descriptor>& vertex_of) {
    const auto& cuts = refinement_.edge_cuts();
    std::vector<halfedge_descriptor> halfedges;
    for (const auto& cut : cuts) halfedges.push_back(descriptor(cut.edge));
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const halfedge_descriptor h = halfedges[k];
      const double begin = k > 0 && cuts[k - 1].edge == cuts[k].edge ? cuts[k - 1].position : 0;
      const Point a = get(points_, vertex_of[surface_.source(cuts[k].edge)]);
      const Point b = get(points_, vertex_of[surface_.target(cuts[k].edge)]);
      const double t = cuts[k].position;
      const auto in_doubles = [](const Point& p) {
        return Eigen::Vector3d(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
      };
      const Eigen::Vector3d p = point_between(in_doubles(a), in_doubles(b), t);
      visitor_.before_edge_split(h, (t - begin) / (1 - begin), mesh_);
      const bool is_marked = has_mark(edge(h, mesh_));
      const halfedge_descriptor added = CGAL::Euler::split_edge(h, mesh_);
      if (is_marked) put(constrained_, edge(added, mesh_), true);
      put(points_, target(added, mesh_), Point(p.x(), p.y(), p.z()));
      vertex_of.push_back(target(added, mesh_));
      visitor_.edge_split(added, mesh_);
    }
    report_.vertices_added = cuts.size();
  }

  /// Cuts the triangles of a face off, one by one.
  /// \param into_first_corner the halfedge of the face that ends at corner 0
  void divide(const Surface_refinement::Cut_face& cut, halfedge_descriptor into_first_corner) {
    const std::size_t corners = cut.corners.size();
    std::vector<halfedge_descriptor> into;  // each corner, in what is left of the face
    std::vector<std::size_t> previous, following;
    halfedge_descriptor h = into_first_corner;
    for (std::size_t i = 0; i < corners; ++i, h = next(h, mesh_)) {
      into.push_back(h);
      previous.push_back((i + corners - 1) % corners);
      following.push_back((i + 1) % corners);
    }

    visitor_.before_subface_creations(face(into_first_corner, mesh_), mesh_);
    std::size_t triangle = 0, rest = 0;
    for (const std::size_t ear : cut.division.ears()) {
      const std::size_t a = previous[ear], b = following[ear];
      const halfedge_descriptor closing = CGAL::Euler::split_face(into[a], into[b], mesh_);
      if (cut.division.is_chord(a, b)) put(constrained_, edge(closing, mesh_), true);
      put(segments_, face(into[ear], mesh_), segment_of(cut, triangle++));
      visitor_.after_subface_created(face(into[ear], mesh_), mesh_);
      into[b] = closing;
      following[a] = b;
      previous[b] = a;
      rest = b;
    }
    put(segments_, face(into[rest], mesh_), segment_of(cut, triangle));
    visitor_.after_subface_creations(mesh_);
    report_.faces_added += triangle;
    ++report_.faces_divided;
  }

  bool has_mark([[maybe_unused]] const edge_descriptor& e) const {
    if constexpr (is_readable_map<ConstrainedMap, edge_descriptor>)
      return static_cast<bool>(get(constrained_, e));
    else
      return false;
  }

  Segment segment_of(const Surface_refinement::Cut_face& cut, std::size_t triangle) const {
    return static_cast<Segment>(refinement_.segment_of_triangle(cut, triangle));
  }

  TriangleMesh& mesh_;
  const Dual_mesh_of<TriangleMesh>& dual_;
  const Triangle_surface& surface_;
  const Surface_refinement& refinement_;
  SegmentIdMap segments_;
  ConstrainedMap constrained_;
  VertexPointMap points_;
  Visitor& visitor_;
  Split_report report_;
};

}  // namespace internal

/// Cuts the curves of `smooth_boundaries()` into the mesh, so that segments are bounded by smooth chains of edges (3.2).
///
/// Where a curve crosses an edge, the edge gets a vertex; the faces crossed are divided into triangles along the curves,
/// such that the lowest triangle is as high as can be. New vertices lie on old edges, so that the surface does not move:
/// area, volume and distances are the same up to rounding. Faces between a curve and the edges it came from change their
/// segment.
///
/// \code
/// auto is_boundary = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_boundary", false).first;
/// split_along_boundaries(mesh, smooth_boundaries(mesh, ids), ids,
///                        CGAL::parameters::edge_is_constrained_map(is_boundary));
/// \endcode
///
/// Everything is worked out before the mesh is touched: if the curves cannot be cut in, the mesh and the maps are what
/// they were. Only the memory running out or a visitor that throws may leave a mesh cut in part; it is a valid one where
/// the mesh can reserve memory, as `Surface_mesh` can.
///
/// Complexity: O(m) for m faces, and O(n^3) for each face that n - 3 new vertices lie on, few as a rule.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam TriangleMesh a model of CGAL's `FaceListGraph` and `MutableFaceGraph`, all faces triangles
/// \tparam SegmentIdMap a read-write property map from `face_descriptor` to an integer; it is written for new faces, too
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param curves as `smooth_boundaries()` gives them for this mesh and these segments: a curve for each boundary, each
/// of them between the segments that it names
/// \param segment_ids the segment of each face, before and after
/// \param np
/// - `vertex_point_map` (read-write, default: that of the mesh)
/// - `edge_is_constrained_map` (writable map from `edge_descriptor` to `bool`, default: none): all edges of all curves
/// are marked, others are left alone; where the map can be read, both parts of a marked edge that is split are marked
/// - `visitor` (see `Default_split_visitor`, default: that; taken by value): is told what is split, to carry
/// attributes along
/// \returns what was done
/// \throws std::invalid_argument if a face is no triangle, a coordinate is not finite, a point of a curve is not on the
/// mesh, two consecutive ones do not belong to one face, curves cross or touch, a new triangle would be lower than a
/// millionth of the mean edge length, or the curves do not bound the segments; nothing is changed then
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class TriangleMesh,
          class Point = internal::Mesh_point<TriangleMesh>, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Split_report split_along_boundaries(TriangleMesh& mesh, const std::vector<Boundary_curve<TriangleMesh, Point>>& curves,
                                    SegmentIdMap segment_ids,
                                    const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<TriangleMesh>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<TriangleMesh>::edge_descriptor;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a read-write property map from the mesh's face_descriptor to an integer.");
  static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Edge_is_constrained,
                                   CGAL::internal_np::visitor_t>,
                "split_along_boundaries() takes the named parameters vertex_point_map, edge_is_constrained_map and "
                "visitor.");

  const auto points = choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point),
                                       CGAL::get_property_map(CGAL::vertex_point, mesh));
  const auto dual = internal::with_threads<ConcurrencyTag>(
      [&] { return Dual_mesh_of<TriangleMesh>(mesh, CGAL::parameters::vertex_point_map(points)); });
  internal::require_triangles(dual);
  const auto segment_of_face = dual.read_faces(segment_ids, [](auto id) { return static_cast<std::size_t>(id); });
  const internal::Triangle_surface surface(dual);
  const std::vector<internal::Surface_curve> surface_curves = internal::surface_curves(curves, dual, surface);
  using Refinement = internal::Surface_refinement;
  const Refinement refinement(surface, surface_curves, segment_of_face,
                              Refinement::least_relative_height * surface.mean_edge_length());
  internal::require_no_faults(refinement);

  auto visitor = choose_parameter(get_parameter(np, CGAL::internal_np::visitor), Default_split_visitor<TriangleMesh>());
  const auto constrained = choose_parameter(get_parameter(np, CGAL::internal_np::edge_is_constrained),
                                            CGAL::Static_boolean_property_map<edge_descriptor, false>());
  const internal::Split_maps<SegmentIdMap, std::decay_t<decltype(constrained)>, std::decay_t<decltype(points)>> maps = {
      segment_ids, constrained, points};
  return internal::Refinement_step(mesh, dual, refinement, maps, visitor)();
}

}  // namespace RW_segmentation

#endif
