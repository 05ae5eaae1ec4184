#ifndef RW_SEGMENTATION_TRANSFER_SEGMENTS_H
#define RW_SEGMENTATION_TRANSFER_SEGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Graph_walk.h>
#include <RW_segmentation/internal/Triangle_tree.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/read_segments.h>
#include <RW_segmentation/internal/settle_band.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The triangles of a mesh in the coordinates of another one's unit box.
template <class FaceListGraph, class NamedParameters, class OtherPoints>
std::vector<Fan_triangle> triangles_in_frame(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                                             const NamedParameters& np, const OtherPoints& frame) {
  const Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  std::vector<Fan_triangle> triangles = fan_triangles(mesh, graph, point);
  const double scale = point.unit() / frame.unit();
  const Eigen::Vector3d shift = (point.origin() - frame.origin()) / frame.unit();
  for (Fan_triangle& triangle : triangles) {
    triangle.corner = scale * triangle.corner + shift;
    triangle.first_side *= scale;
    triangle.second_side *= scale;
  }
  return triangles;
}

/// For each face the one of the reduced mesh that is closest to its centroid and looks the same way; the closest of all
/// where none does.
inline std::vector<Dual_graph::Index> closest_faces(const Face_geometry& geometry, const Triangle_tree& reduced) {
  std::vector<Dual_graph::Index> closest(geometry.centroid.size());
  parallel_stretches(closest.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      auto found = reduced.closest_face(geometry.centroid[f], geometry.normal[f]);
      if (!found) found = reduced.closest_face(geometry.centroid[f], Eigen::Vector3d::Zero());
      if (!found) throw std::invalid_argument("the reduced mesh has no face with an area");
      closest[f] = *found;
    }
  });
  return closest;
}

/// Connected regions of faces with one label.
inline Components regions_of(const Dual_graph& graph, const std::vector<std::size_t>& labels) {
  std::vector<double> joins(graph.number_of_edges());
  for (Dual_graph::Index e = 0; e < joins.size(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    joins[e] = labels[f] == labels[g];
  }
  return components(graph, joins);
}

/// The regions of each label on the reduced mesh, counted.
inline std::map<std::size_t, std::size_t> regions_of_labels(const Dual_graph& graph,
                                                            const std::vector<std::size_t>& labels) {
  const Components regions = regions_of(graph, labels);
  std::map<std::size_t, std::size_t> count;
  std::vector<char> is_counted(regions.count, false);
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!std::exchange(is_counted[regions.of[f]], true)) ++count[labels[f]];
  return count;
}

/// Marks the faces of all regions but the largest ones of each label, of which there are as many as `expected`.
inline std::vector<char> faces_of_spurious_regions(const Dual_graph& graph, const std::vector<double>& area,
                                                   const std::vector<std::size_t>& labels,
                                                   std::map<std::size_t, std::size_t> expected) {
  const Components regions = regions_of(graph, labels);
  struct Region {
    double area;
    std::size_t label, number;
  };
  std::vector<Region> by_size(regions.count);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    Region& region = by_size[regions.of[f]];
    region = {region.area + area[f], labels[f], regions.of[f]};
  }
  std::stable_sort(by_size.begin(), by_size.end(), [](const Region& a, const Region& b) { return a.area > b.area; });
  std::vector<char> is_spurious(regions.count, false);
  for (const Region& region : by_size) {
    std::size_t& left = expected[region.label];
    is_spurious[region.number] = left == 0;
    if (left > 0) --left;
  }
  std::vector<char> result;
  for (const auto region : regions.of) result.push_back(is_spurious[region]);
  return result;
}

/// For each label whose faces all lie in the band, the one that is deepest in its segment: last in the order in which
/// the band was reached.
inline std::vector<Dual_graph::Index> cores_within(const std::vector<Dual_graph::Index>& band,
                                                   const std::vector<char>& is_in_band,
                                                   const std::vector<std::size_t>& labels) {
  std::map<std::size_t, Dual_graph::Index> deepest;
  for (const auto face : band) deepest[labels[face]] = face;
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!is_in_band[f]) deepest.erase(labels[f]);
  std::vector<Dual_graph::Index> cores;
  for (const auto& [label, face] : deepest) cores.push_back(face);
  return cores;
}

}  // namespace internal

/// Carries the segments of a reduced mesh to the mesh that it was made of (section 3.2 of the paper).
///
/// Each face takes the segment of the closest face of the reduced mesh that looks the same way, so that the two sides of a
/// thin sheet stay apart. Then the faces along the boundaries are walked on by their own conductances: boundaries move
/// to the features of the full resolution. Patches that only the projection has cut off from their segments are walked
/// on, too. No segment gets lost while a face of it is found.
///
/// The meshes need not share vertices or connectivity: any simplification or remeshing will do, such as CGAL's edge collapse.
/// For large meshes `segmentation_via_random_walks()` reduces the walk by itself, which is faster than to make a reduced
/// mesh.
///
/// \tparam ReducedMesh a model of CGAL's `FaceListGraph`
/// \tparam ReducedIdMap a readable property map from its face descriptors to an integer
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam ConductanceMap a readable property map from its edge descriptors to `double`, such as `Conductance`
/// \tparam SegmentIdMap a writable property map from its face descriptors to an integer
/// \tparam ReducedNamedParameters, NamedParameters sequences of CGAL's named parameters
/// \param reduced the reduced mesh, in the place of the full one
/// \param reduced_ids its segments
/// \param mesh the full mesh
/// \param conductance how easily walks cross the edges of the full mesh
/// \param segment_ids output, the ids of the reduced mesh
/// \param band how many faces on either side of a boundary are walked on; about the length of a reduced edge in full
/// ones. 0 leaves what the closest faces say
/// \param np `vertex_point_map` of the full mesh, `callback` (`std::function<bool(double)>`, `false` cancels)
/// \param reduced_np `vertex_point_map` of the reduced mesh
/// \returns the number of different ids written
/// \throws std::invalid_argument if the reduced mesh has no face with an area while the full one has faces, a conductance
/// is negative or NaN, or a coordinate not finite; nothing is written then
/// \throws Cancelled; nothing is written then
///
/// Complexity: O(m log n) for m faces and n of the reduced mesh, and that of the walk on the bands.
template <class ReducedMesh, class ReducedIdMap, class FaceListGraph, class ConductanceMap, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class ReducedNamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t transfer_segments(const ReducedMesh& reduced, const ReducedIdMap& reduced_ids, const FaceListGraph& mesh,
                              const ConductanceMap& conductance, SegmentIdMap segment_ids, std::size_t band = 6,
                              const NamedParameters& np = CGAL::parameters::default_values(),
                              const ReducedNamedParameters& reduced_np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a writable property map from the mesh's face_descriptor to an integer.");
  static_assert(internal::is_readable_map<ReducedIdMap, typename boost::graph_traits<ReducedMesh>::face_descriptor>,
                "reduced_ids must be a readable property map from the reduced mesh's face_descriptor to an integer.");
  using Id = typename boost::property_traits<SegmentIdMap>::value_type;
  const Progress progress = internal::progress_of(np);
  progress(0);
  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const std::vector<double> conductances = internal::read_edge_values(graph, conductance, "the conductance");
  const internal::Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, point);

  const Mesh_dual_graph<ReducedMesh> reduced_graph(reduced);
  const std::vector<std::size_t> ids = internal::read_segments(reduced_graph, reduced_ids);
  std::vector<std::size_t> reduced_labels;
  const std::vector<std::size_t> id_of_label = internal::rank_labels(ids, reduced_labels);
  const internal::Triangle_tree tree(internal::triangles_in_frame(reduced, reduced_graph, reduced_np, point));
  std::vector<std::size_t> labels;
  labels.reserve(graph.number_of_faces());
  for (const auto closest : internal::closest_faces(geometry, tree)) labels.push_back(reduced_labels[closest]);
  progress(0.5);

  if (band > 0) {
    std::vector<Dual_graph::Index> along = internal::band_along_boundaries(graph, labels, band);
    std::vector<char> is_in_band = internal::faces_of_spurious_regions(
        graph, geometry.area, labels, internal::regions_of_labels(reduced_graph, reduced_labels));
    for (const auto face : along) is_in_band[face] = true;
    internal::settle_band(graph, conductances, is_in_band, internal::cores_within(along, is_in_band, labels), labels,
                          progress.part(0.5, 1));
  }
  progress(1);
  std::vector<char> is_written(id_of_label.size(), false);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    put(segment_ids, graph.face_descriptors()[f], static_cast<Id>(id_of_label[labels[f]]));
    is_written[labels[f]] = true;
  }
  return static_cast<std::size_t>(std::count(is_written.begin(), is_written.end(), true));
}

}  // namespace RW_segmentation

#endif
