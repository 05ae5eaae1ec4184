// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENT_SURFACES_H
#define RW_SEGMENTATION_SEGMENT_SURFACES_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace RW_segmentation {

namespace internal {

struct Surface_tolerance;

/// The surfaces of the segments of a mesh in the unit box.
/// \param segment_of_face numbers from 0 to `number_of_segments` - 1
std::vector<Analytic_surface> surfaces_in_unit_box(const Dual_mesh& mesh,
                                                   const std::vector<std::size_t>& segment_of_face,
                                                   std::size_t number_of_segments, const Surface_tolerance& tolerance);

/// \param segment_of_face numbers from 0 to `number_of_segments` - 1
std::vector<Analytic_surface> surfaces_of_segments(const Dual_mesh& mesh,
                                                   const std::vector<std::size_t>& segment_of_face,
                                                   std::size_t number_of_segments, double noise);

}  // namespace internal

/// The plane, sphere, cylinder, cone or torus that each segment of a mesh lies on, whichever way it was segmented.
///
/// The type of each surface is chosen by at most 500 vertices of the segment, see `fit_analytic_surface()`, and its numbers
/// are fitted, in the sense of least squares, to all vertices but those that are far off beside the others. Where no surface
/// fits all, one that holds 95 percent of the area is taken: a segmentation may have got a few faces wrong. Where all
/// vertices lie on two circles round one axis, as in the chamfers of a CAD kernel, spheres pass through them as well as
/// cylinders and cones; a sphere is returned then if it joins a neighbour smoothly, and the other one otherwise.
/// The standard errors (`Analytic_surface::errors`) are those of the least squares: they hold as far as the distances of
/// vertices are independent of each other. Complexity: linear in the number of faces, and that of some fits for each segment.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to integers
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segments, from 0 to `number_of_segments` - 1
/// \param number_of_segments what `segmentation_into_surfaces()` returned
/// \param noise the standard deviation of the vertices from the surfaces, as a part of the diagonal of the bounding
/// box; negative: estimated from the mesh
/// \param np `vertex_point_map` (default: that of the mesh)
/// \returns the surface of each segment, in the mesh's coordinates; a free form where none fits
/// \throws std::invalid_argument if an id is out of range, or a coordinate or the noise is not finite
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Analytic_surface> segment_surfaces(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                                               std::size_t number_of_segments, double noise = -1,
                                               const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::is_readable_map<SegmentIdMap, typename boost::graph_traits<FaceListGraph>::face_descriptor>,
                "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");
  static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                "segment_surfaces() takes the named parameter vertex_point_map.");
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const std::vector<std::size_t> segment_of_face = dual.read_segments(segment_ids);
    for (const std::size_t segment : segment_of_face)
      if (segment >= number_of_segments)
        throw internal::argument_error("a segment id", segment,
                                       ("less than " + std::to_string(number_of_segments)).c_str());
    return internal::surfaces_of_segments(dual, segment_of_face, number_of_segments, noise);
  });
}

/// With noise as the mesh has it, and named parameters after the number.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap, class T,
          class Tag, class Base>
std::vector<Analytic_surface> segment_surfaces(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                                               std::size_t number_of_segments,
                                               const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return segment_surfaces<ConcurrencyTag>(mesh, segment_ids, number_of_segments, -1, np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/segment_surfaces.h>
#endif

#endif
