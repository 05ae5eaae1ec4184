#ifndef RW_SEGMENTATION_LOCAL_THICKNESS_H
#define RW_SEGMENTATION_LOCAL_THICKNESS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Triangle_tree.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Where and how the thickness of a solid is measured.
struct Thickness_sampling {
  std::size_t samples = 500;  ///< faces, evenly spread over the area
  std::size_t rays = 7;       ///< for each of them
  double cone_angle = 0.5;    ///< between the outermost ray and the inward normal, in radians, below pi / 2
};

namespace internal {

/// \throws std::invalid_argument
inline void require_thickness_numbers(const Thickness_sampling& sampling) {
  if (sampling.rays == 0) throw argument_error("rays", sampling.rays, "positive");
  if (!(sampling.cone_angle >= 0 && sampling.cone_angle < std::acos(0.)))
    throw argument_error("cone_angle", sampling.cone_angle, "from 0 to less than pi / 2");
}

/// The median distance to the other side along rays in a cone about the inward normal; 0 if no ray leaves the solid.
inline double thickness_below(const Triangle_tree& tree, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                              Dual_graph::Index face, const Thickness_sampling& sampling) {
  constexpr double golden_angle = 2.39996322972865332;
  const Eigen::Vector3d axis = -normal, u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<double> distances;
  for (std::size_t ray = 0; ray < sampling.rays; ++ray) {
    // A sunflower: rays spread evenly over the cone.
    const auto i = static_cast<double>(ray), last = static_cast<double>(std::max<std::size_t>(sampling.rays, 2) - 1);
    const double angle = sampling.cone_angle * std::sqrt(i / last), azimuth = golden_angle * i;
    const Eigen::Vector3d side = std::cos(azimuth) * u + std::sin(azimuth) * v;
    const double distance = tree.exit_distance(point, std::cos(angle) * axis + std::sin(angle) * side, face);
    if (std::isfinite(distance)) distances.push_back(distance);
  }
  if (distances.empty()) return 0;
  const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  return *median;
}

/// The core of `local_thickness()`: in the unit of the geometry, in the order of the faces.
inline std::vector<double> thickness_of_faces(const Face_geometry& geometry, const Triangle_tree& tree,
                                              const Thickness_sampling& sampling, const Progress& progress) {
  constexpr std::size_t samples_between_reports = 100;
  std::vector<double> thickness(geometry.area.size(), 0.);
  const double area_per_sample = geometry.total_area / static_cast<double>(sampling.samples);
  double area = 0;
  std::size_t samples = 0;
  for (const Fan_triangle& triangle : tree.triangles()) {
    // A sample stands in the middle of each stretch of the curve that covers the same area.
    area += triangle.first_side.cross(triangle.second_side).norm() / 2;
    if (!(area > (static_cast<double>(samples) + 0.5) * area_per_sample)) continue;
    if (samples % samples_between_reports == 0)
      progress(static_cast<double>(samples) / static_cast<double>(sampling.samples));
    samples = static_cast<std::size_t>(std::llround(area / area_per_sample));
    const Dual_graph::Index f = triangle.face;
    if (thickness[f] == 0 && !geometry.normal[f].isZero(0))
      thickness[f] = thickness_below(tree, geometry.centroid[f], geometry.normal[f], f, sampling);
  }
  return thickness;
}

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
template <class FaceListGraph, class ThicknessMap, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t local_thickness(const FaceListGraph& mesh, ThicknessMap thickness, const Thickness_sampling& sampling = {},
                            const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<ThicknessMap, face_descriptor>,
                "thickness must be a writable property map from the mesh's face_descriptor to double.");
  internal::require_thickness_numbers(sampling);

  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const internal::Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, point);
  const internal::Triangle_tree tree(internal::fan_triangles(mesh, graph, point));
  const std::vector<double> measured =
      internal::thickness_of_faces(geometry, tree, sampling, internal::progress_of(np));
  std::size_t faces_measured = 0;
  for (std::size_t f = 0; f < measured.size(); ++f) {
    faces_measured += measured[f] > 0;
    put(thickness, graph.face_descriptors()[f], measured[f] * geometry.unit);
  }
  return faces_measured;
}

}  // namespace RW_segmentation

#endif
