#ifndef RW_SEGMENTATION_SIZE_AWARE_COST_H
#define RW_SEGMENTATION_SIZE_AWARE_COST_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

template <class T>
constexpr bool is_named_parameters = false;
template <class T, class Tag, class Base>
constexpr bool is_named_parameters<CGAL::Named_function_parameters<T, Tag, Base>> = true;

/// The formula of `Size_aware_cost`, which needs no mesh.
class Size_aware_formula {
 public:
  struct Region {
    double area = 0;           ///< in units of R^2
    double log_thickness = 0;  ///< sum over the samples
    double samples = 0;
  };

  void join(Region& region, const Region& other) const {
    region.area += other.area;
    region.log_thickness += other.log_thickness;
    region.samples += other.samples;
  }

  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const {
    const auto& [length, difference] = boundary.common;
    const double size = a.area + b.area > 0 ? a.area * b.area / (a.area + b.area) : 0;
    return (difference / length + least_difference) * size / length * (1 + thickness_weight * thickness_step(a, b));
  }

 private:
  static constexpr double least_difference = 0.1;
  static constexpr double thickness_weight = 2;
  static constexpr double largest_thickness_step = 2;
  static constexpr double fewest_samples = 3;

  static double thickness_step(const Region& a, const Region& b) {
    if (a.samples < fewest_samples || b.samples < fewest_samples) return 0;
    return std::min(std::abs(a.log_thickness / a.samples - b.log_thickness / b.samples), largest_thickness_step);
  }
};

/// The regions of single faces.
/// \param thickness of each face, not positive where none was measured; empty: of no face
inline std::vector<Size_aware_formula::Region> size_aware_regions(const Face_geometry& geometry,
                                                                  const std::vector<double>& thickness) {
  std::vector<Size_aware_formula::Region> regions(geometry.area.size());
  for (std::size_t f = 0; f < regions.size(); ++f) {
    if (geometry.total_area > 0) regions[f].area = geometry.area[f] / geometry.total_area;
    if (thickness.empty() || !(thickness[f] > 0) || !std::isfinite(thickness[f])) continue;
    regions[f].log_thickness = std::log(thickness[f]);
    regions[f].samples = 1;
  }
  return regions;
}

}  // namespace internal

/// The merge cost that agrees best with people, a model of `MergeCost`: regions that are large, meet along a short and
/// concave boundary and differ in thickness stay apart longest.
///
/// cost = (D/L + 0.1) * a b / (a + b) * R/L * (1 + 2 min(|s_a - s_b|, 2)) with the mean difference D/L along the common
/// boundary of length L, the areas a and b as fractions of the total area R^2, and the mean logarithms s of the
/// thickness. By the 0.1 sizes and lengths decide where there is no difference at all. The last factor is 1 unless both regions hold three samples of the thickness or more. Does not depend on
/// the scale of the mesh. Where the difference is a concavity (`Dihedral_difference` with convex weight 0, angles and
/// smoothed normals), merging is best stopped at cost 1.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Size_aware_cost : public internal::Size_aware_formula {
 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;

  /// Without thickness. Complexity: linear.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a coordinate is not finite, naming the vertex
  template <class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
  explicit Size_aware_cost(const FaceListGraph& mesh, const NamedParameters& np = CGAL::parameters::default_values())
      : Size_aware_cost(mesh, np, [](face_descriptor) { return 0.; }) {}

  /// With thickness. Complexity: linear.
  ///
  /// \tparam ThicknessMap a readable property map from `face_descriptor` to `double`
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param thickness how thick the solid is below a face, in any unit; 0 where it is not known, as `local_thickness()`
  /// writes it
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a coordinate is not finite, naming the vertex
  template <class ThicknessMap, class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<!internal::is_named_parameters<ThicknessMap>, int> = 0>
  Size_aware_cost(const FaceListGraph& mesh, const ThicknessMap& thickness,
                  const NamedParameters& np = CGAL::parameters::default_values())
      : Size_aware_cost(mesh, np, [&](face_descriptor f) { return static_cast<double>(get(thickness, f)); }) {
    static_assert(internal::is_readable_map<ThicknessMap, face_descriptor>,
                  "thickness must be a readable property map from the mesh's face_descriptor to double.");
  }

  /// The region of a single face.
  Region region(face_descriptor face) const { return (*regions_)[face]; }

 private:
  template <class NamedParameters, class Thickness>
  Size_aware_cost(const FaceListGraph& mesh, const NamedParameters& np, const Thickness& thickness) {
    const Mesh_dual_graph<FaceListGraph> graph(mesh);
    std::vector<double> values;
    values.reserve(graph.number_of_faces());
    for (const face_descriptor f : graph.face_descriptors()) values.push_back(thickness(f));
    const auto regions = internal::size_aware_regions(internal::face_geometry(mesh, graph, np), values);
    auto table = std::make_shared<Table>(Region());
    table->reserve(regions.size());
    for (std::size_t f = 0; f < regions.size(); ++f) table->insert(graph.face_descriptors()[f], regions[f]);
    regions_ = std::move(table);
  }

  using Table = internal::Descriptor_table<face_descriptor, Region>;
  std::shared_ptr<const Table> regions_;
};

}  // namespace RW_segmentation

#endif
