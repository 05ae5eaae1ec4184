// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TRANSFER_SEGMENTS_H
#define RW_SEGMENTATION_TRANSFER_SEGMENTS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/mesh/Triangle_tree.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/rank_labels.h>
#include <RW_segmentation/internal/walk/read_conductances.h>
#include <RW_segmentation/internal/walk/settle_band.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The triangles of a mesh in the coordinates of another one's unit box.
inline std::vector<Fan_triangle> triangles_in_frame(const Dual_mesh& mesh, const Dual_mesh& frame) {
  std::vector<Fan_triangle> triangles = fan_triangles(mesh);
  const double scale = mesh.unit() / frame.unit();
  const Eigen::Vector3d shift = (mesh.origin() - frame.origin()) / frame.unit();
  for (Fan_triangle& triangle : triangles) {
    triangle.corner = scale * triangle.corner + shift;
    triangle.first_side *= scale;
    triangle.second_side *= scale;
  }
  return triangles;
}

/// For each face the one of the reduced mesh that is closest to its centroid and looks the same way; the closest of all
/// where none does.
inline std::vector<Dual_mesh::Index> closest_faces(const Dual_mesh& mesh, const Triangle_tree& reduced) {
  std::vector<Dual_mesh::Index> closest(mesh.number_of_faces());
  parallel_stretches(closest.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      auto found = reduced.closest_face(mesh.centroids()[f], mesh.normals()[f]);
      if (!found) found = reduced.closest_face(mesh.centroids()[f], Eigen::Vector3d::Zero());
      if (!found) throw std::invalid_argument("the reduced mesh has no face with an area");
      closest[f] = *found;
    }
  });
  return closest;
}

/// Connected regions of faces with one label.
inline Components regions_of(const Dual_mesh& mesh, const std::vector<std::size_t>& labels) {
  return {mesh.graph(), [&](Dual_mesh::Index e) {
            const auto [f, g] = mesh.graph().faces_of(e);
            return labels[f] == labels[g] && !mesh.is_wall(e);
          }};
}

/// How many regions each label has.
inline std::map<std::size_t, std::size_t> regions_of_labels(const Components& regions,
                                                            const std::vector<std::size_t>& labels) {
  std::map<std::size_t, std::size_t> count;
  std::vector<char> is_counted(regions.count, false);
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!std::exchange(is_counted[regions.of[f]], true)) ++count[labels[f]];
  return count;
}

/// Marks the faces of all regions but the largest ones of each label, of which there are as many as `expected`.
inline std::vector<char> faces_of_spurious_regions(const Components& regions, const std::vector<double>& area,
                                                   const std::vector<std::size_t>& labels,
                                                   std::map<std::size_t, std::size_t> expected) {
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
inline std::vector<Dual_mesh::Index> cores_within(const std::vector<Dual_mesh::Index>& band,
                                                  const std::vector<char>& is_in_band,
                                                  const std::vector<std::size_t>& labels) {
  std::map<std::size_t, Dual_mesh::Index> deepest;
  for (const auto face : band) deepest[labels[face]] = face;
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!is_in_band[f]) deepest.erase(labels[f]);
  std::vector<Dual_mesh::Index> cores;
  for (const auto& [label, face] : deepest) cores.push_back(face);
  return cores;
}

/// The ids that the faces of the full mesh get from those of the reduced one, by face.
inline std::vector<std::size_t> transferred(const Dual_mesh& reduced, const std::vector<std::size_t>& reduced_ids,
                                            const Dual_mesh& mesh, const std::vector<double>& conductances,
                                            std::size_t band, const Progress& progress) {
  std::vector<std::size_t> reduced_labels;  // any number may be an id
  const std::vector<std::size_t> id_of_label = rank_labels(reduced_ids, reduced_labels);
  const Triangle_tree tree(triangles_in_frame(reduced, mesh));
  std::vector<std::size_t> labels;
  labels.reserve(mesh.number_of_faces());
  for (const auto closest : closest_faces(mesh, tree)) labels.push_back(reduced_labels[closest]);
  progress(0.5);
  if (band > 0) {
    const std::vector<Dual_mesh::Index> along = band_along_boundaries(mesh.graph(), labels, band);
    std::vector<char> is_in_band =
        faces_of_spurious_regions(regions_of(mesh, labels), mesh.areas(), labels,
                                  regions_of_labels(regions_of(reduced, reduced_labels), reduced_labels));
    for (const auto face : along) is_in_band[face] = true;
    settle_band(mesh.graph(), conductances, is_in_band, cores_within(along, is_in_band, labels), labels,
                progress.part(0.5, 1));
  }
  progress(1);
  for (std::size_t& label : labels) label = id_of_label[label];
  return labels;
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
/// \tparam ReducedMesh a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam ReducedIdMap a readable property map from its face descriptors to an integer
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam ConductanceMap `Conductance`, or what `as_conductance()` makes of a map of one's own
/// \tparam SegmentIdMap a writable property map from its face descriptors to an integer
/// \tparam ReducedNamedParameters, NamedParameters sequences of CGAL's named parameters
/// \param reduced the reduced mesh, in the place of the full one
/// \param reduced_ids its segments
/// \param mesh the full mesh
/// \param conductance how easily walks cross the edges of the full mesh
/// \param segment_ids output, the ids of the reduced mesh
/// \param band how many faces on either side of a boundary are walked on; about the length of a reduced edge in full
/// ones. 0 leaves what the closest faces say
/// \param np `vertex_point_map` and `edge_is_constrained_map` of the full mesh, `callback`
/// (`std::function<bool(double)>`, `false` cancels)
/// \param reduced_np `vertex_point_map` and `edge_is_constrained_map` of the reduced mesh
/// \returns the number of different ids written
/// \throws std::invalid_argument if the reduced mesh has no face with an area while the full one has faces, a conductance
/// is negative or not finite, or a coordinate not finite; nothing is written then
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
  static_assert(internal::has_conductances<ConductanceMap>,
                "transfer_segments() needs conductances: Conductance(mesh, difference), or as_conductance(map) for "
                "values of your own.");
  static_assert(
      internal::has_only<NamedParameters, internal::Vertex_point, internal::Edge_is_constrained, internal::Callback>,
      "transfer_segments() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  static_assert(internal::has_only<ReducedNamedParameters, internal::Vertex_point, internal::Edge_is_constrained>,
                "transfer_segments() takes the named parameters vertex_point_map and edge_is_constrained_map of the "
                "reduced mesh.");
  const Progress progress = internal::progress_of(np);
  progress(0);
  const auto& full = internal::dual_mesh(mesh, np);
  const std::vector<double> conductances = internal::read_conductances(full, conductance);
  const auto& coarse = internal::dual_mesh(reduced, reduced_np);
  const auto ids = coarse.read_faces(reduced_ids, [](const auto& id) { return static_cast<std::size_t>(id); });
  const auto transferred = internal::transferred(coarse, ids, full, conductances, band, progress);
  // What may run out of memory comes before the first id is written.
  const std::size_t segments = std::set<std::size_t>(transferred.begin(), transferred.end()).size();
  full.write_faces(std::vector<Id>(transferred.begin(), transferred.end()), segment_ids);
  return segments;
}

}  // namespace RW_segmentation

#endif
