#ifndef RW_SEGMENTATION_COARSE_SEEDS_H
#define RW_SEGMENTATION_COARSE_SEEDS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/graph/two_bit_color_map.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Ends coarse seeding at exactly so many seeds; a model of `SeedStopPredicate`.
class Seed_count_stop {
 public:
  /// \throws std::invalid_argument if `number_of_seeds` is 0
  explicit Seed_count_stop(std::size_t number_of_seeds) : number_of_seeds_(number_of_seeds) {
    if (number_of_seeds == 0) throw internal::argument_error("number_of_seeds", number_of_seeds, "at least 1");
  }

  /// Whether there are enough seeds without the candidate.
  bool operator()(const std::vector<double>& separation) const { return separation.size() > number_of_seeds_; }

 private:
  std::size_t number_of_seeds_;
};

/// Ends coarse seeding where the separation of the seeds falls below a threshold; a model of `SeedStopPredicate`.
///
/// The recommended one: on the meshes of the Princeton Segmentation Benchmark, segments grown from its seeds differ
/// less from those of people than with `Separation_decrease_stop` or any one count.
class Separation_threshold_stop {
 public:
  /// \param threshold the least separation of a seed, in the units of `coarse_seeds()`
  /// \throws std::invalid_argument unless `threshold` is finite and not negative
  explicit Separation_threshold_stop(double threshold = 0.4) : threshold_(threshold) {
    if (!(threshold >= 0 && std::isfinite(threshold)))
      throw internal::argument_error("threshold", threshold, "finite and not negative");
  }

  /// A candidate that no difference separates from the seeds is never a seed.
  bool operator()(const std::vector<double>& separation) const {
    return separation.back() == 0 || separation.back() < threshold_;
  }

 private:
  double threshold_;
};

/// Ends coarse seeding where the separation of the seeds has decreased significantly, as in section 4.1 of the paper; a
/// model of `SeedStopPredicate`.
///
/// The decrease is measured from the largest separation, that of the second seed of a component: on natural shapes
/// separations decline in many small steps, so that the step from one seed to the next tells little.
class Separation_decrease_stop {
 public:
  /// \param decrease the fraction of the largest separation that counts as a significant decrease
  /// \throws std::invalid_argument unless 0 < `decrease` <= 1
  explicit Separation_decrease_stop(double decrease = 0.6) : decrease_(decrease) {
    if (!(decrease > 0 && decrease <= 1)) throw internal::argument_error("decrease", decrease, "above 0 and at most 1");
  }

  /// A candidate that no difference separates from the seeds is never a seed.
  bool operator()(const std::vector<double>& separation) const {
    const double candidate = separation.back();
    const double largest =
        *std::find_if(separation.begin(), separation.end() - 1, [](double s) { return std::isfinite(s); });
    return candidate == 0 || candidate < (1 - decrease_) * largest;
  }

 private:
  double decrease_;
};

namespace internal {

/// The lengths of the shortest paths over a dual graph from a growing set of source faces, by Boost's Dijkstra;
/// infinite where no path leads.
class Path_lengths {
 public:
  using Index = Dual_graph::Index;

  /// Keeps references to both arguments. `edge_length` is in the order of the edges, none is negative.
  Path_lengths(const Dual_graph& graph, const std::vector<double>& edge_length)
      : graph_(graph),
        edge_length_(edge_length),
        length_(graph.number_of_faces(), std::numeric_limits<double>::infinity()),
        colour_(graph.number_of_faces()) {}

  double operator()(Index face) const { return length_[face]; }

  /// Adds all sources in one run, which sees only those arcs that shorten a path: it visits the faces that come closer
  /// and their neighbours, no others.
  void add_sources(const std::vector<Index>& sources) {
    for (const Index source : sources) length_[source] = 0;
    const boost::filtered_graph shortening(graph_, Shortens{edge_length_.data(), length_.data()});
    const auto length_of_arc = boost::make_function_property_map<Dual_graph::Arc>(
        [this](const Dual_graph::Arc& arc) { return edge_length_[arc.edge]; });
    const auto length_of_path = boost::make_iterator_property_map(length_.begin(), index_);
    boost::dijkstra_shortest_paths_no_init(shortening, sources.begin(), sources.end(), boost::dummy_property_map(),
                                           length_of_path, length_of_arc, index_, std::less<double>(),
                                           std::plus<double>(), 0., Whiten{colour_}, colour_);
  }

 private:
  using Index_map = boost::typed_identity_property_map<Index>;
  using Colour_map = boost::two_bit_color_map<Index_map>;

  struct Shortens {
    const double *edge_length, *length;
    bool operator()(const Dual_graph::Arc& arc) const {
      return length[arc.source] + edge_length[arc.edge] < length[arc.target];
    }
  };

  /// Leaves the colours as the next run wants them. No arc shortens the path to a finished face.
  struct Whiten : boost::dijkstra_visitor<> {
    Colour_map colour;
    explicit Whiten(const Colour_map& map) : colour(map) {}
    template <class Graph>
    void finish_vertex(Index face, const Graph&) {
      put(colour, face, boost::two_bit_white);
    }
  };

  const Dual_graph& graph_;
  const std::vector<double>& edge_length_;
  std::vector<double> length_;
  Index_map index_;
  Colour_map colour_;
};

/// The distances between the centroids of neighbouring faces, in the order of the edges: geodesic distance is the
/// length of a path over centroids.
inline std::vector<double> centroid_distances(const Dual_graph& graph, const Face_geometry& geometry) {
  std::vector<double> distance;
  distance.reserve(graph.number_of_edges());
  for (std::size_t e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(static_cast<Dual_graph::Index>(e));
    distance.push_back((geometry.centroid[f] - geometry.centroid[g]).norm());
  }
  return distance;
}

/// The faces of each connected component in ascending order, the components in the order of their lowest faces.
inline std::vector<std::vector<Dual_graph::Index>> faces_of_components(const Dual_graph& graph) {
  std::vector<std::vector<Dual_graph::Index>> components;
  std::vector<bool> reached(graph.number_of_faces(), false);
  for (std::size_t f = 0; f < graph.number_of_faces(); ++f) {
    if (reached[f]) continue;
    reached[f] = true;
    std::vector<Dual_graph::Index> component = {static_cast<Dual_graph::Index>(f)};
    for (std::size_t i = 0; i < component.size(); ++i)
      for (const auto [g, edge] : graph.neighbours(component[i])) {
        if (reached[g]) continue;
        reached[g] = true;
        component.push_back(g);
      }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

/// In units of the mean difference, and of the bounding box's diagonal for distances: above the rounding of sums, far
/// below what tells two places on a mesh apart.
constexpr double rounding = 1e-9;

/// The faces with the greatest value but for rounding errors, in their order. Taking them for equal makes the seeds of a
/// symmetric mesh the same in every position.
template <class Value>
std::vector<Dual_graph::Index> with_greatest(const std::vector<Dual_graph::Index>& faces, const Value& value,
                                             double rounding_error) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const auto f : faces) greatest = std::max(greatest, value(f));
  std::vector<Dual_graph::Index> result;
  for (const auto f : faces)
    if (value(f) >= greatest - rounding_error) result.push_back(f);
  return result;
}

/// The face of a component that is closest to the component's centroid, every point of the surface counting alike.
inline Dual_graph::Index face_closest_to_centroid(const std::vector<Dual_graph::Index>& component,
                                                  const Face_geometry& geometry) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto f : component) {
    moment += geometry.area[f] * geometry.centroid[f];
    area += geometry.area[f];
  }
  if (!(area > 0)) return component.front();
  const Eigen::Vector3d centroid = moment / area;
  const auto closeness = [&](auto f) { return -(geometry.centroid[f] - centroid).norm(); };
  return with_greatest(component, closeness, rounding).front();
}

/// The first seed of each component: the face geodesically farthest from the face closest to the centroid.
inline std::vector<Dual_graph::Index> first_seeds(const Dual_graph& graph, const Face_geometry& geometry,
                                                  const std::vector<double>& centroid_distance) {
  const auto components = faces_of_components(graph);
  std::vector<Dual_graph::Index> seeds;
  for (const auto& component : components) seeds.push_back(face_closest_to_centroid(component, geometry));
  Path_lengths from_centre(graph, centroid_distance);
  from_centre.add_sources(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = with_greatest(components[i], from_centre, rounding).front();
  return seeds;
}

/// The mean of those differences that are finite.
inline double mean_difference(const std::vector<double>& differences) {
  double mean = 0;
  for (const double d : differences)
    if (std::isfinite(d)) mean += d / static_cast<double>(differences.size());
  return mean;
}

/// The core of `coarse_seeds()`: `differences` are in the order of the edges.
template <class SeedStopPredicate>
std::vector<Dual_graph::Index> coarse_seeds(const Dual_graph& graph, const Face_geometry& geometry,
                                            const std::vector<double>& differences, const SeedStopPredicate& stop,
                                            const Progress& progress) {
  using Index = Dual_graph::Index;
  const std::vector<double> centroid_distance = centroid_distances(graph, geometry);
  std::vector<Index> seeds = first_seeds(graph, geometry, centroid_distance);

  std::vector<double> separation;
  while (separation.size() < seeds.size()) {
    separation.push_back(std::numeric_limits<double>::infinity());
    if (stop(separation))
      throw argument_error("the number of seeds at which stop ends", separation.size() - 1,
                           ("at least " + std::to_string(seeds.size()) + ", one for each component").c_str());
  }

  Path_lengths difference(graph, differences);  // to the nearest seed
  std::vector<Index> others(graph.number_of_faces());
  std::iota(others.begin(), others.end(), Index(0));
  std::vector<bool> is_seed(graph.number_of_faces(), false);
  const auto start_paths_at = [&](const std::vector<Index>& faces) {
    difference.add_sources(faces);
    for (const Index f : faces) is_seed[f] = true;
    others.erase(std::remove_if(others.begin(), others.end(), [&](Index f) { return is_seed[f]; }), others.end());
  };

  Path_lengths distance(graph, centroid_distance);  // to the nearest seed, brought up to date where it decides
  std::size_t seeds_in_distance = 0;
  const auto most_distant = [&](const std::vector<Index>& faces) {
    if (faces.size() == 1) return faces.front();
    distance.add_sources({seeds.begin() + static_cast<std::ptrdiff_t>(seeds_in_distance), seeds.end()});
    seeds_in_distance = seeds.size();
    return with_greatest(faces, distance, rounding).front();
  };

  start_paths_at(seeds);
  const double mean = mean_difference(differences);
  const double unit = mean * std::sqrt(static_cast<double>(graph.number_of_faces()));
  while (!others.empty()) {
    progress(1 - 1 / static_cast<double>(seeds.size()));
    const Index next = most_distant(with_greatest(others, difference, rounding * mean));
    separation.push_back(difference(next) > 0 ? difference(next) / unit : 0);
    if (stop(separation)) return seeds;
    seeds.push_back(next);
    start_paths_at({next});
  }
  separation.push_back(0);
  if (!seeds.empty() && !stop(separation))
    throw argument_error("the number of seeds at which stop ends", "larger",
                         ("at most " + std::to_string(seeds.size()) + ", the number of faces").c_str());
  return seeds;
}

}  // namespace internal

/// Finds few seeds, one for each large structure of a mesh (section 4.1 of the paper, Eq. 9).
///
/// The first seed is the face geodesically farthest from the face closest to the mesh's centroid. Each further one is
/// the face with the largest separation: with D(f, g) = the least sum of differences over all paths of faces from f to
/// g, the face that maximises min D(f, s) over the seeds s so far. Of faces equally separated, as on a flat mesh, it is
/// the one at the largest geodesic distance from the seeds, then the one that comes first in `faces(mesh)`. Geodesic
/// distance is the length of a path over the centroids of faces. It ends where `stop` finds the last separation too
/// small; that candidate is no seed.
///
/// Separations are told in units of the mean difference times the square root of the number of faces, which is about
/// the number of edges on a way across the mesh. So they depend neither on the resolution of the mesh nor on the scale
/// of the difference.
///
/// Each connected component gets a first seed of its own; these come first, and their separation is infinite.
///
/// A difference that sees convex edges, too, tells the parts of a shape apart best: the angle between smoothed normals
/// with a convex weight of 0.5, even where the walk afterwards heeds concave edges alone.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
/// \tparam Difference a readable property map from `edge_descriptor` to a number >= 0: `Dihedral_difference`,
/// `Curvature_difference`, a stored map, a lambda in a `boost::function_property_map`; it is asked once for each edge
/// \tparam SeedStopPredicate a function from `const std::vector<double>&`, the separations of the seeds in their order
/// with that of the candidate at the end, to `bool`, whether seeding ends without the candidate: `Seed_count_stop`,
/// `Separation_threshold_stop`, `Separation_decrease_stop`, a lambda
/// \tparam OutputIterator accepts `face_descriptor`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh; without faces it gets no seeds
/// \param difference how much the two faces beside an edge differ
/// \param stop when to end
/// \param seeds output, the seeds in the order in which they were found
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, `false` cancels)
/// \returns `seeds` after the last seed written
/// \throws std::invalid_argument if `stop` ends before each component has a seed or when all faces are seeds, if a
/// difference is negative or NaN, or a coordinate is not finite; nothing is written then
/// \throws Cancelled if the callback ends it; nothing is written then
///
/// Complexity: a run of Dijkstra's algorithm a seed, warm-started: it visits the faces that come closer only, so that
/// n faces and k seeds take O(n log n log k) on most meshes instead of O(k n log n), plus O(k n) comparisons.
template <class FaceListGraph, class Difference, class SeedStopPredicate, class OutputIterator,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator coarse_seeds(const FaceListGraph& mesh, const Difference& difference, const SeedStopPredicate& stop,
                            OutputIterator seeds, const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(std::is_invocable_r_v<bool, const SeedStopPredicate&, const std::vector<double>&>,
                "stop must be a function from std::vector<double>, the separations of the seeds, to bool.");
  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, np);
  const std::vector<double> differences = internal::read_edge_values(graph, difference, "difference");
  for (const auto f : internal::coarse_seeds(graph, geometry, differences, stop, internal::progress_of(np)))
    *seeds++ = graph.face(f);
  return seeds;
}

}  // namespace RW_segmentation

#endif
