// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_LOCAL_THICKNESS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_LOCAL_THICKNESS_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Triangle_tree.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/local_thickness.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace RW_segmentation::internal {

/// \throws std::invalid_argument
inline void require_cone(std::size_t rays, double cone_angle) {
  if (rays == 0) throw argument_error("rays", rays, "positive");
  if (!(cone_angle >= 0 && cone_angle < std::acos(0.)))
    throw argument_error("cone_angle", cone_angle, "from 0 to less than pi / 2");
}

/// The directions of rays in a cone about an axis, which turn from one to the next like the seeds of a sunflower.
class Ray_cone {
 public:
  /// Rays that cover the cone evenly.
  static Ray_cone even(std::size_t rays, double cone_angle) {
    const auto last = static_cast<double>(std::max<std::size_t>(rays, 2) - 1);
    return {rays, [&](double i) { return cone_angle * std::sqrt(i / last); }};
  }

  /// Rays whose density falls with the distance from the axis, as those of CGAL's shape diameters.
  static Ray_cone dense_at_axis(std::size_t rays, double cone_angle) {
    const double slope = std::tan(cone_angle) / static_cast<double>(rays);
    return {rays, [&](double i) { return std::atan(slope * i); }};
  }

  /// The distances to the other side along the rays about the inward normal, as far as they leave the solid.
  void measure(const Triangle_tree& tree, const Dual_mesh& mesh, Dual_mesh::Index face,
               std::vector<double>& distances) const {
    distances.clear();
    for_each_exit(tree, mesh.centroid(face), -mesh.normal(face), face, [&](double distance) {
      if (std::isfinite(distance)) distances.push_back(distance);
    });
  }

  /// Calls `use(distance)` for each ray in turn, with the distance at which it leaves the solid; infinity if it does not.
  /// \param start the face that the rays begin on
  template <class Use>
  void for_each_exit(const Triangle_tree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                     Dual_mesh::Index start, const Use& use) const {
    const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    for (const Ray& ray : rays_) {
      const Eigen::Vector3d side = ray.along_u * u + ray.along_v * v;
      use(tree.exit_distance(origin, ray.along_axis * axis + ray.aside * side, start));
    }
  }

 private:
  struct Ray {
    double along_axis, aside, along_u, along_v;
  };

  /// \param angle_to_axis a function of the number of the ray
  template <class Angle>
  Ray_cone(std::size_t rays, const Angle& angle_to_axis) {
    constexpr double golden_angle = 2.39996322972865332;
    for (std::size_t ray = 0; ray < rays; ++ray) {
      const auto i = static_cast<double>(ray);
      const double angle = angle_to_axis(i), azimuth = golden_angle * i;
      rays_.push_back({std::cos(angle), std::sin(angle), std::cos(azimuth), std::sin(azimuth)});
    }
  }

  std::vector<Ray> rays_;
};

/// The upper one of two; 0 of none. Changes the order.
inline double median_of(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), median, values.end());
  return *median;
}

/// The mean of those that are not much farther from the median than half of them; 0 of none.
/// \param workspace for the deviations
inline double mean_without_outliers(std::vector<double>& values, std::vector<double>& workspace) {
  constexpr double farthest = 1.5;  // in median deviations, CGAL's number
  const double median = median_of(values);
  workspace.clear();
  for (const double value : values) workspace.push_back(std::abs(value - median));
  const double limit = farthest * median_of(workspace);
  double sum = 0, number = 0;
  for (const double value : values) {
    if (std::abs(value - median) > limit) continue;
    sum += value;
    ++number;
  }
  return number > 0 ? sum / number : 0;
}

/// Faces that lie evenly over the area, each once: one in the middle of each stretch of the curve that covers the same
/// area. Those without area are left out.
/// \param area_before that which the curve has covered before it comes to these triangles
inline std::vector<Dual_mesh::Index> evenly_spread_faces(const Dual_mesh& mesh, const Triangle_tree& tree,
                                                         std::size_t samples_of_whole, double area_before) {
  constexpr double most_samples = 1e15;  // faces that overlap themselves have fans of any size beside their own area
  std::vector<Dual_mesh::Index> faces;
  const double area_per_sample = mesh.total_area() / static_cast<double>(samples_of_whole);
  if (!(area_per_sample > 0)) return faces;
  std::vector<char> is_sampled(mesh.number_of_faces(), false);
  double area = area_before;
  const auto samples_up_to = [&](double a) { return std::round(std::min(a / area_per_sample, most_samples)); };
  double samples = samples_up_to(area_before);
  for (std::size_t i = 0; i < tree.number_of_triangles(); ++i) {
    const Fan_triangle triangle = tree.triangle(i);
    area += triangle.first_side.cross(triangle.second_side).norm() / 2;
    if (!(area > (samples + 0.5) * area_per_sample)) continue;
    samples = samples_up_to(area);
    const Dual_mesh::Index f = triangle.face;
    if (!is_sampled[f] && !mesh.normal(f).isZero(0)) faces.push_back(f);
    is_sampled[f] = true;
  }
  return faces;
}

RW_SEGMENTATION_INLINE std::vector<double> thickness_of_faces(const Dual_mesh& mesh, const Thickness_sampling& sampling,
                                                              const Progress& progress) {
  require_cone(sampling.rays, sampling.cone_angle);
  const Ray_cone cone = Ray_cone::even(sampling.rays, sampling.cone_angle);
  const Triangle_tree tree(mesh);
  constexpr std::size_t samples_between_reports = 100;
  std::vector<double> thickness(mesh.number_of_faces(), 0.), distances;
  const std::vector<Dual_mesh::Index> faces = evenly_spread_faces(mesh, tree, sampling.samples, 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i % samples_between_reports == 0) progress(static_cast<double>(i) / static_cast<double>(faces.size()));
    cone.measure(tree, mesh, faces[i], distances);
    thickness[faces[i]] = median_of(distances);
  }
  return thickness;
}

RW_SEGMENTATION_INLINE std::vector<Thickness_probe> thickness_probes(const Dual_mesh& part, std::size_t number_of_faces,
                                                                     std::size_t samples_of_whole, double area_before) {
  std::vector<Thickness_probe> probes;
  for (const Dual_mesh::Index f :
       evenly_spread_faces(part, Triangle_tree(part, number_of_faces), samples_of_whole, area_before))
    probes.push_back({f, part.centroid(f), -part.normal(f)});
  return probes;
}

RW_SEGMENTATION_INLINE std::vector<double> probe_exits(const Dual_mesh& part, std::size_t number_of_faces,
                                                       const std::vector<Thickness_probe>& probes,
                                                       const Thickness_sampling& sampling) {
  require_cone(sampling.rays, sampling.cone_angle);
  const Ray_cone cone = Ray_cone::even(sampling.rays, sampling.cone_angle);
  const Triangle_tree tree(part, number_of_faces);
  std::vector<double> exits;
  exits.reserve(probes.size() * sampling.rays);
  for (const Thickness_probe& probe : probes)
    cone.for_each_exit(tree, probe.origin, probe.axis, probe.face, [&](double distance) { exits.push_back(distance); });
  return exits;
}

RW_SEGMENTATION_INLINE double thickness_by_exits(std::vector<double> exits) {
  exits.erase(std::remove_if(exits.begin(), exits.end(), [](double d) { return !std::isfinite(d); }), exits.end());
  return median_of(exits);
}

/// The shape diameter of every face; 0 where no ray leaves the solid and where a face has no area.
template <class ConcurrencyTag>
std::vector<double> shape_diameters(const Dual_mesh& mesh, const Ray_cone& cone, const Progress& progress) {
  const Triangle_tree tree(mesh);
  std::vector<double> thickness(mesh.number_of_faces(), 0.);
  const auto make_worker = [&] {
    return [&, distances = std::vector<double>(), workspace = std::vector<double>()](std::size_t i) mutable {
      const auto f = static_cast<Dual_mesh::Index>(i);
      if (mesh.normal(f).isZero(0)) return;
      cone.measure(tree, mesh, f, distances);
      thickness[f] = mean_without_outliers(distances, workspace);
    };
  };
  parallel_for<ConcurrencyTag>(thickness.size(), make_worker, progress);
  return thickness;
}

/// Gives faces whose thickness is 0 the mean of their neighbours, ring by ring, and the least of all where a component
/// has none.
/// \returns how many such faces there were
inline std::size_t fill_gaps(const Dual_mesh& mesh, std::vector<double>& thickness) {
  const auto is_measured = [&](Dual_mesh::Index f) { return thickness[f] > 0; };
  const auto number_of_gaps =
      static_cast<std::size_t>(std::count_if(thickness.begin(), thickness.end(), [](double t) { return !(t > 0); }));
  if (number_of_gaps == 0 || number_of_gaps == thickness.size()) return number_of_gaps;

  double least = std::numeric_limits<double>::infinity();
  std::vector<Dual_mesh::Index> last;  // the faces that got a thickness last: first those where it was measured
  for (Dual_mesh::Index f = 0; f < thickness.size(); ++f)
    if (is_measured(f)) {
      least = std::min(least, thickness[f]);
      last.push_back(f);
    }
  const auto mean_of_neighbours = [&](Dual_mesh::Index f) {
    double sum = 0, known = 0;
    for (const auto& [next, edge] : mesh.graph().neighbours(f)) {
      if (!is_measured(next) || mesh.is_wall(edge)) continue;
      sum += thickness[next];
      ++known;
    }
    return sum / known;
  };
  std::vector<char> is_reached(thickness.size(), false);
  std::vector<std::pair<Dual_mesh::Index, double>> ring;
  while (!last.empty()) {  // each face is beside one ring, and in one
    ring.clear();
    for (const Dual_mesh::Index f : last)
      for (const auto& [next, edge] : mesh.graph().neighbours(f))
        if (!is_measured(next) && !mesh.is_wall(edge) && !std::exchange(is_reached[next], true))
          ring.emplace_back(next, mean_of_neighbours(next));
    last.clear();
    for (const auto& [face, value] : ring) {
      thickness[face] = value;
      last.push_back(face);
    }
  }
  for (double& t : thickness)
    if (!(t > 0)) t = least;
  return number_of_gaps;
}

/// The bilateral filter of CGAL's shape diameters: a mean over the faces round each face, in which those weigh less that
/// are farther away or differ more.
template <class ConcurrencyTag>
std::vector<double> smoothed_thickness(const Dual_mesh& mesh, const std::vector<double>& thickness,
                                       const Progress& progress) {
  using Index = Dual_mesh::Index;
  // CGAL's numbers.
  constexpr double faces_of_a_ring = 2000;   // windows widen by a ring of faces at 1, 4, 9, ... times so many faces
  constexpr double spatial_deviation = 0.5;  // of the weights of rings, in windows
  constexpr double range_deviation = 1.5;    // of the weights of differences, in root mean squares of these
  const std::size_t faces = mesh.number_of_faces();
  const auto rings = static_cast<std::size_t>(std::sqrt(static_cast<double>(faces) / faces_of_a_ring)) + 1;
  const auto gauss = [](double x) { return std::exp(-x * x / 2); };
  std::vector<double> weight_of_ring;
  for (std::size_t ring = 0; ring <= rings; ++ring)
    weight_of_ring.push_back(gauss(static_cast<double>(ring) / (spatial_deviation * static_cast<double>(rings))));

  std::vector<double> smoothed(faces);
  struct Window {
    std::vector<Index> faces, last_visit;  // `last_visit` by face: the window it was last part of
    std::vector<std::size_t> end_of_ring;
  };
  const auto make_worker = [&] {
    return [&, window = Window{{}, std::vector<Index>(faces, static_cast<Index>(-1)), {}}](std::size_t i) mutable {
      const auto centre = static_cast<Index>(i);
      window.faces.assign(1, centre);
      window.last_visit[centre] = centre;
      window.end_of_ring.assign(1, 1);
      for (std::size_t ring = 1, next = 0; ring <= rings; ++ring) {
        for (; next < window.end_of_ring.back(); ++next)
          for (const auto& [g, edge] : mesh.graph().neighbours(window.faces[next])) {
            if (window.last_visit[g] == centre || mesh.is_wall(edge)) continue;
            window.last_visit[g] = centre;
            window.faces.push_back(g);
          }
        window.end_of_ring.push_back(window.faces.size());
      }
      double squares = 0;
      for (const Index f : window.faces) squares += std::pow(thickness[f] - thickness[centre], 2);
      const double deviation = range_deviation * std::sqrt(squares / static_cast<double>(window.faces.size()));
      if (!(deviation > 0)) {
        smoothed[centre] = thickness[centre];
        return;
      }
      double sum = 0, weights = 0;
      for (std::size_t ring = 0, k = 0; ring <= rings; ++ring)
        for (; k < window.end_of_ring[ring]; ++k) {
          const double value = thickness[window.faces[k]];
          const double weight = weight_of_ring[ring] * gauss((value - thickness[centre]) / deviation);
          sum += weight * value;
          weights += weight;
        }
      smoothed[centre] = sum / weights;
    };
  };
  parallel_for<ConcurrencyTag>(faces, make_worker, progress);
  return smoothed;
}

/// Scales from 0 to 1; all are 0 where all are alike.
inline void normalise_thickness(std::vector<double>& thickness, double least, double greatest, Thickness_scale scale) {
  constexpr double alpha = 5;  // CGAL's number: how much thin parts are spread
  for (double& t : thickness) {
    t = greatest > least ? (t - least) / (greatest - least) : 0;
    if (scale == Thickness_scale::logarithmic) t = std::log1p(alpha * t) / std::log1p(alpha);
  }
}

template <class ConcurrencyTag>
std::vector<double> thickness_by_face(const Dual_mesh& mesh, const Thickness_of_faces& numbers,
                                      Thickness_report& report, const Progress& progress) {
  require_cone(numbers.rays, numbers.cone_angle);
  const Ray_cone cone = Ray_cone::dense_at_axis(numbers.rays, numbers.cone_angle);
  std::vector<double> thickness = shape_diameters<ConcurrencyTag>(mesh, cone, progress.part(0, 0.9));
  report.gaps = fill_gaps(mesh, thickness);
  if (numbers.is_smoothed) thickness = smoothed_thickness<ConcurrencyTag>(mesh, thickness, progress.part(0.9, 1));
  for (double& t : thickness) t *= mesh.unit();
  if (!thickness.empty()) {
    const auto [least, greatest] = std::minmax_element(thickness.begin(), thickness.end());
    report.least = *least;
    report.greatest = *greatest;
  }
  if (numbers.scale != Thickness_scale::length)
    normalise_thickness(thickness, report.least, report.greatest, numbers.scale);
  return thickness;
}

}  // namespace RW_segmentation::internal

#endif
