// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_LOCAL_THICKNESS_H
#define RW_SEGMENTATION_LOCAL_THICKNESS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Where and how the thickness of a solid is measured by `local_thickness()`.
struct Thickness_sampling {
  std::size_t samples = 500;  ///< faces, evenly spread over the area
  std::size_t rays = 7;       ///< for each of them
  double cone_angle = 0.5;    ///< between the outermost ray and the inward normal, in radians, below pi / 2
};

/// In what the thickness of all faces is told.
enum class Thickness_scale {
  length,      ///< in the mesh's unit of length
  linear,      ///< from 0 for the thinnest face to 1 for the thickest, as `CGAL::sdf_values()` does
  logarithmic  ///< log(1 + 5 t) / log 6 of that, which spreads thin parts, as CGAL does before it clusters the values
};

/// How `thickness_of_all_faces()` measures. The numbers are those of CGAL's shape diameter function.
struct Thickness_of_faces {
  std::size_t rays = 25;                   ///< for each face
  double cone_angle = 1.0471975511965976;  ///< as in `Thickness_sampling`; pi / 3 is CGAL's whole angle of 2 pi / 3
  bool is_smoothed = false;                ///< whether noise is smoothed away, steps of the thickness are kept
  Thickness_scale scale = Thickness_scale::length;  ///< of what is written
};

/// What `thickness_of_all_faces()` found.
struct Thickness_report {
  double least = 0;      ///< before it is scaled, in the mesh's unit of length
  double greatest = 0;   ///< before it is scaled, in the mesh's unit of length
  std::size_t gaps = 0;  ///< faces where nothing could be measured, and that got what their neighbours have
};

namespace internal {

/// In the unit box, in the order of the faces.
/// \throws std::invalid_argument, Cancelled
std::vector<double> thickness_of_faces(const Dual_mesh& mesh, const Thickness_sampling& sampling,
                                       const Progress& progress);

/// Where the thickness of a solid is measured that is known in parts.
struct Thickness_probe {
  Dual_mesh::Index face;         ///< of the part at hand; no face of it where the probe stands on another one
  Eigen::Vector3d origin, axis;  ///< in the unit box: the face's centroid, and into the solid
};

/// Probes on the first faces of a part of a mesh, as evenly spread as on the whole.
/// \param samples_of_whole on the whole mesh
/// \param area_before that of the parts before this one
std::vector<Thickness_probe> thickness_probes(const Dual_mesh& part, std::size_t number_of_faces,
                                              std::size_t samples_of_whole, double area_before);

/// The distances at which the rays of each probe leave the solid through the first faces of a part, probe by probe;
/// infinity where they do not.
std::vector<double> probe_exits(const Dual_mesh& part, std::size_t number_of_faces,
                                const std::vector<Thickness_probe>& probes, const Thickness_sampling& sampling);

/// The thickness by the exits of the rays of a probe, the nearest ones of all parts; 0 where none leaves the solid.
double thickness_by_exits(std::vector<double> exits);

/// The thickness by face.
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag>
std::vector<double> thickness_by_face(const Dual_mesh& mesh, const Thickness_of_faces& numbers,
                                      Thickness_report& report, const Progress& progress);

}  // namespace internal

/// Measures how thick the solid inside a mesh is below some of its faces: the median length of a few rays from the
/// face's centroid, in a cone about the inward normal, to where they leave the solid.
///
/// A cue for merging: parts of one thickness belong together (see `Size_aware_cost`). This is the shape diameter of
/// Shapira, Shamir and Cohen-Or (2008), on few faces and with few rays. The rays meet the faces in a tree of boxes of
/// our own, made for few rays: no GPL package of CGAL is needed. Faces of more than three sides are met as fans of
/// triangles. Through the border of an open mesh rays leave without being counted.
///
/// Complexity: O(m log m) for m faces, and O(log m) for each ray in general.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam ThicknessMap a writable property map from `face_descriptor` to `double`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param thickness output: the thickness in the mesh's unit of length, 0 where none was measured
/// \param sampling how many faces and rays
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, default: none)
/// \returns the number of faces where thickness was measured: fewer than asked for where a face is large, and none from
/// which no ray leaves the solid
/// \throws std::invalid_argument if there are no rays, the angle is out of range, or a coordinate is not finite
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ThicknessMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t local_thickness(const FaceListGraph& mesh, ThicknessMap thickness, const Thickness_sampling& sampling = {},
                            const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<ThicknessMap, face_descriptor>,
                "thickness must be a writable property map from the mesh's face_descriptor to double.");
  static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Callback>,
                "local_thickness() takes the named parameters vertex_point_map and callback.");
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const std::vector<double> measured = internal::thickness_of_faces(dual, sampling, internal::progress_of(np));
    std::size_t faces_measured = 0;
    for (std::size_t f = 0; f < measured.size(); ++f) {
      faces_measured += measured[f] > 0;
      put(thickness, dual.face_descriptors()[f], measured[f] * dual.unit());
    }
    return faces_measured;
  });
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ThicknessMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t local_thickness(const FaceListGraph& mesh, ThicknessMap thickness, const NamedParameters& np) {
  return local_thickness<ConcurrencyTag>(mesh, thickness, Thickness_sampling(), np);
}

/// Measures how thick the solid inside a mesh is below every face, as the shape diameter function does: the mean length,
/// outliers left out, of rays from the face's centroid, in a cone about the inward normal and denser near it, to where they
/// leave the solid.
///
/// No face is left without a value: where no ray leaves the solid and where a face has no area, it gets the mean of its
/// neighbours, ring by ring; a component where nothing is measured gets the least thickness of all; 0 stands for nothing
/// but a mesh where no ray leaves anywhere. On request the values are smoothed by the bilateral filter of
/// `CGAL::sdf_values_postprocessing()`, which keeps steps, and scaled from 0 to 1. Neither filling nor smoothing crosses
/// walls.
///
/// For `Size_aware_cost` take lengths: there, 0 means that nothing is known.
///
/// Complexity: O(m log m) for m faces, and O(log m) for each ray in general. Smoothing looks at about a thousandth of all
/// faces round each face, as CGAL's does: its windows grow with the mesh.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree, or a `Dual_mesh_of` one
/// \tparam ThicknessMap a writable property map from `face_descriptor` to `double`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param thickness output: the thickness of each face
/// \param numbers how many rays, and what is made of the values
/// \param np may follow `thickness` directly: `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map`
/// (default: no edge is): walls, `callback` (`std::function<bool(double)>`, default: none)
/// \returns the least and the greatest thickness, and how many gaps were filled
/// \throws std::invalid_argument if there are no rays, the angle is out of range, or a coordinate is not finite; nothing is
/// written then
/// \throws Cancelled; nothing is written then
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ThicknessMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Thickness_report thickness_of_all_faces(const FaceListGraph& mesh, ThicknessMap thickness,
                                        const Thickness_of_faces& numbers = {},
                                        const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<ThicknessMap, face_descriptor>,
                "thickness must be a writable property map from the mesh's face_descriptor to double.");
  static_assert(
      internal::has_only_names_of_stages<NamedParameters>,
      "thickness_of_all_faces() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  return internal::with_threads<ConcurrencyTag>([&] {
    Thickness_report report;
    const auto& dual = internal::dual_mesh(mesh, np);
    dual.write_faces(internal::thickness_by_face<ConcurrencyTag>(dual, numbers, report, internal::progress_of(np)),
                     thickness);
    return report;
  });
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ThicknessMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
Thickness_report thickness_of_all_faces(const FaceListGraph& mesh, ThicknessMap thickness, const NamedParameters& np) {
  return thickness_of_all_faces<ConcurrencyTag>(mesh, thickness, Thickness_of_faces(), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/local_thickness.h>
#endif

#endif
