#ifndef RW_SEGMENTATION_SEGMENT_SURFACES_H
#define RW_SEGMENTATION_SEGMENT_SURFACES_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/read_segments.h>
#include <RW_segmentation/merge_segments.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// From the coordinates of `Face_geometry` to those of the mesh.
inline Analytic_surface in_mesh_coordinates(Analytic_surface surface, const Face_geometry& geometry) {
  surface.point = geometry.unit * surface.point + geometry.origin;
  surface.radius *= geometry.unit;
  surface.tube_radius *= geometry.unit;
  surface.residual *= geometry.unit;
  return surface;
}

}  // namespace internal

/// The plane, sphere, cylinder, cone or torus that each segment of a mesh lies on, whichever way it was segmented.
///
/// Each surface is fitted, in the sense of least squares, to at most 500 vertices of the segment; see
/// `fit_analytic_surface()`. Where all vertices lie on two circles round one axis, as in the chamfers of a CAD kernel,
/// spheres pass through them as well as cones, and either may be returned. Complexity: linear in the number of faces, and constant for each segment.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to integers
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segments, from 0 to `number_of_segments` - 1
/// \param number_of_segments what `segmentation_via_random_walks()` returned
/// \param noise the standard deviation of the vertices from the surfaces, as a part of the diagonal of the bounding
/// box; negative: estimated from the mesh
/// \param np `vertex_point_map` (default: that of the mesh)
/// \returns the surface of each segment, in the mesh's coordinates; a free form where none fits
/// \throws std::invalid_argument if an id is out of range, or a coordinate or the noise is not finite
template <class FaceListGraph, class SegmentIdMap, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Analytic_surface> segment_surfaces(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                                               std::size_t number_of_segments, double noise = -1,
                                               const NamedParameters& np = CGAL::parameters::default_values()) {
  constexpr std::size_t most_samples = 500;
  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const std::vector<std::size_t> segment_of_face = internal::read_segments(graph, segment_ids);
  for (const std::size_t segment : segment_of_face)
    if (segment >= number_of_segments)
      throw internal::argument_error("a segment id", segment,
                                     ("less than " + std::to_string(number_of_segments)).c_str());

  const internal::Surface_data data = internal::surface_data(mesh, graph, noise, np);
  const auto formula = data.formula(most_samples);
  const auto regions = internal::join_faces(segment_of_face, number_of_segments, formula, [&](std::size_t f) {
    return formula.region_of(static_cast<Dual_graph::Index>(f));
  });
  std::vector<Analytic_surface> surfaces;
  for (const auto& region : regions)
    surfaces.push_back(internal::in_mesh_coordinates(formula.surface_of(region), *data.geometry));
  return surfaces;
}

}  // namespace RW_segmentation

#endif
