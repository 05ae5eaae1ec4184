#ifndef RW_SEGMENTATION_INTERNAL_SURFACE_GROWING_H
#define RW_SEGMENTATION_INTERNAL_SURFACE_GROWING_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <boost/container_hash/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

constexpr double degrees = 3.14159265358979323846 / 180;

/// How far a mesh may be from the surfaces it approximates. Lengths are parts of the diagonal of its bounding box.
struct Surface_tolerance {
  double noise = 0;                  ///< standard deviation of the vertices, 0 if it is below `distance`
  double distance = 0;               ///< the standard deviation that is reckoned with
  std::vector<double> normal_angle;  ///< between a face and the surface that it is part of, in radians

  /// What a vertex is allowed: three deviations, or less under noise, which would hide smooth joints otherwise.
  double largest_distance() const { return (noise > 0 ? 2.25 : 3) * distance; }

  /// The angle between two faces that no analytic surface and no noise explains.
  double sharp_angle(const std::array<Dual_graph::Index, 2>& faces) const {
    return std::max(40 * degrees, noise > 0 ? normal_angle[faces[0]] + normal_angle[faces[1]] : 0);
  }
};

/// \param exactness the least distance that counts
/// \param noise standard deviation of the vertices
inline Surface_tolerance surface_tolerance(const Face_geometry& geometry, const Face_corners& corners, double exactness,
                                           double noise) {
  constexpr double tessellation = 12 * degrees;  // half of what kernels let an arc turn along an edge
  Surface_tolerance tolerance;
  tolerance.noise = noise > exactness ? noise : 0;
  tolerance.distance = std::max(noise, exactness);
  for (Dual_graph::Index f = 0; f < geometry.area.size(); ++f) {
    const double height = 2 * geometry.area[f] / std::max(corners.extent(f), std::numeric_limits<double>::min());
    const double tilt = tolerance.noise > 0 ? tolerance.noise / std::max(height, 0.1 * tolerance.noise) : 0;
    tolerance.normal_angle.push_back(std::min(tessellation + 3 * tilt, 3.));
  }
  return tolerance;
}

/// The angle between the faces of each edge, 0 where one of them has no normal.
inline std::vector<double> edge_angles(const Dual_graph& graph, const Face_geometry& geometry) {
  std::vector<double> angles;
  angles.reserve(graph.number_of_edges());
  for (Dual_graph::Index e = 0; e < graph.number_of_edges(); ++e) {
    const Eigen::Vector3d &m = geometry.normal[graph.faces_of(e)[0]], &n = geometry.normal[graph.faces_of(e)[1]];
    angles.push_back(m.isZero() || n.isZero() ? 0 : 2 * std::asin(std::min(1., (m - n).norm() / 2)));
  }
  return angles;
}

/// Cuts a mesh into connected regions of faces that lie on one analytic surface each, and the remainder.
///
/// A surface is fitted to the neighbourhood of a face, flooded as far as vertices and normals agree, fitted to what was
/// flooded, and so on, until it grows no more. Of all types the one that explains most vertices is kept. Regions that
/// explain many vertices are taken first; `gain` is the number of vertices beyond those that determine the surface.
class Surface_growing {
 public:
  using Index = Dual_graph::Index;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// \param is_barrier which edges no region crosses; kept by reference, as all arguments are
  Surface_growing(const Dual_graph& graph, const Face_geometry& geometry, const Face_corners& corners,
                  const std::vector<char>& is_barrier)
      : graph_(graph),
        geometry_(geometry),
        corners_(corners),
        is_barrier_(is_barrier),
        angle_(edge_angles(graph, geometry)),
        face_mark_(graph.number_of_faces(), 0),
        vertex_mark_(corners.number_of_vertices(), 0),
        region_of_face_(graph.number_of_faces(), none) {}

  /// Estimates the tolerance from what neighbourhoods of faces leave unexplained. Without noise some small ones lie on a
  /// surface exactly, if they avoid edges, even on a coarse mesh. Under noise none does, and larger ones vary less.
  /// \param exactness the least distance that counts
  Surface_tolerance estimate_tolerance(double exactness) {
    constexpr std::size_t few_vertices = 12, many_vertices = 30;
    constexpr double correction_of_few = 2.5, correction_of_many = 1.25;  // a low quantile of the best of five
    const double few = std::min(quantile(0.02, [&](Index f) { return neighbourhood(f, few_vertices); }),
                                quantile(0.02, [&](Index f) { return flattest_neighbourhood(f, few_vertices); }));
    const double noise = correction_of_few * few <= exactness ? 0 : correction_of_many * quantile(0.05, [&](Index f) {
                                                                      return neighbourhood(f, many_vertices);
                                                                    });
    return surface_tolerance(geometry_, corners_, exactness, noise);
  }

  /// Grows all regions. Faces of the remainder have the region `none`.
  void grow(const Surface_tolerance& tolerance, const Progress& progress) {
    tolerance_ = &tolerance;
    std::vector<Index> order(graph_.number_of_faces());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](Index f, Index g) { return geometry_.area[f] > geometry_.area[g]; });
    // By chance, noisy vertices lie on a surface that was fitted to few of them, and pieces of a large surface on
    // others: the largest come first.
    const bool is_noisy = tolerance.noise > 0;
    const std::vector<Pass> passes = is_noisy ? std::vector<Pass>{{1000}, {400}, {160}, {64}, {24}}
                                              : std::vector<Pass>{{64}, {12}, {12, 0, true}, {3, 10}};
    possible_gain_.assign(graph_.number_of_faces(), std::numeric_limits<double>::infinity());
    failures_.assign(graph_.number_of_faces(), {});
    tries_.assign(graph_.number_of_faces(), 0);
    for (std::size_t k = 0; k < passes.size(); ++k)
      for (std::size_t i = 0; i < order.size(); ++i) {
        if (i % 1000 == 0)
          progress((static_cast<double>(k) + static_cast<double>(i) / static_cast<double>(order.size())) /
                   static_cast<double>(passes.size()));
        const Index seed = order[i];
        if (region_of_face_[seed] != none || geometry_.normal[seed].isZero()) continue;
        if (possible_gain_[seed] < passes[k].least_gain) continue;
        Region region = best_region(seed, passes[k]);
        if (region.gain < passes[k].least_gain) {
          if (is_noisy) expect_no_more(seed, region);
          continue;
        }
        if (!is_noisy) prefer_rivals(region, passes[k]);
        for (const Index f : region.patch.faces) region_of_face_[f] = surfaces_.size();
        surfaces_.push_back(region.surface);
      }
  }

  /// Takes regions and their surfaces over that were found on another mesh.
  void adopt(const Surface_tolerance& tolerance, std::vector<std::size_t> region_of_face,
             std::vector<Analytic_surface> surfaces) {
    tolerance_ = &tolerance;
    region_of_face_ = std::move(region_of_face);
    surfaces_ = std::move(surfaces);
  }

  /// Moves faces at the borders of regions to the neighbour whose surface they fit best, and lets faces of the
  /// remainder join a region that they fit. Under noise a face alone cannot tell: short borders count, too, and
  /// surfaces are fitted again to what they have become.
  void settle_borders() {
    constexpr int exact_sweeps = 4, noisy_sweeps = 6, rounds = 4;
    if (tolerance_->noise == 0) {
      const std::vector<double> sign = signs();
      move_faces(exact_sweeps,
                 [&](Index f, std::size_t region) { return region == none ? 2 : misfit(region, sign[region], f); });
      return;
    }
    for (int round = 0; round < rounds; ++round) {
      fit_again();
      const std::vector<double> sign = signs();
      const bool has_moved = move_faces(noisy_sweeps, [&](Index f, std::size_t region) {
        return border_energy(region, f) + (region == none ? unexplained_energy : energy(region, sign[region], f));
      });
      if (!has_moved) break;
    }
  }

  const std::vector<std::size_t>& region_of_face() const { return region_of_face_; }
  const std::vector<Analytic_surface>& surfaces() const { return surfaces_; }
  const std::vector<double>& angles() const { return angle_; }

 private:
  /// Connected faces, and their vertices, in the order in which they were reached.
  struct Patch {
    std::vector<Index> faces, vertices;
  };
  struct Region {
    Patch patch;
    Analytic_surface surface;
    double gain = -std::numeric_limits<double>::infinity();
  };

  /// What the regions about a face gained that were not taken.
  struct Failure {
    std::size_t neighbourhood = 0;  // a hash
    double gain = std::numeric_limits<double>::infinity();
  };

  /// Which regions are taken: those that gain enough, about round neighbourhoods of so many vertices at least or along
  /// narrow ones, too.
  struct Pass {
    double least_gain;
    std::size_t smallest_start = 0;  // smaller ones happen to lie on surfaces all over a free form
    bool along_strips = false;
  };

  // ---- Patches ----

  void start_patch(Patch& patch) {
    ++mark_;
    patch.faces.clear();
    patch.vertices.clear();
  }
  void add(Patch& patch, Index f) {
    face_mark_[f] = mark_;
    patch.faces.push_back(f);
    for (const Index v : corners_[f])
      if (vertex_mark_[v] != mark_) {
        vertex_mark_[v] = mark_;
        patch.vertices.push_back(v);
      }
  }

  void mark_faces(const Patch& patch) {
    ++mark_;
    for (const Index f : patch.faces) face_mark_[f] = mark_;
  }

  bool is_sharp(Index edge) const {
    const double limit = tolerance_ ? tolerance_->sharp_angle(graph_.faces_of(edge)) : 60 * degrees;
    return is_barrier_[edge] || angle_[edge] > limit;
  }

  /// Free faces about a face, breadth first, not across sharp edges, until they have so many vertices.
  Patch neighbourhood(Index seed, std::size_t vertices) {
    Patch patch;
    start_patch(patch);
    add(patch, seed);
    for (std::size_t i = 0; i < patch.faces.size(); ++i)
      for (const auto& [g, e] : graph_.neighbours(patch.faces[i])) {
        if (patch.vertices.size() >= vertices) return patch;
        if (face_mark_[g] != mark_ && region_of_face_[g] == none && !is_sharp(e)) add(patch, g);
      }
    return patch;
  }

  /// Some of the vertices and normals of a patch.
  const Surface_samples& samples_of(const Patch& patch) {
    constexpr std::size_t most = 80;
    samples_.clear();
    for (std::size_t i = 0, step = std::max<std::size_t>(1, patch.vertices.size() / most); i < patch.vertices.size();
         i += step)
      samples_.points.push_back(corners_.point(patch.vertices[i]));
    for (std::size_t i = 0, step = std::max<std::size_t>(1, patch.faces.size() / most); i < patch.faces.size();
         i += step) {
      const Index f = patch.faces[i];
      if (geometry_.normal[f].isZero()) continue;
      samples_.normal_points.push_back(geometry_.centroid[f]);
      samples_.normals.push_back(geometry_.normal[f]);
    }
    return samples_;
  }

  /// As above, but across the flattest edges first.
  Patch flattest_neighbourhood(Index seed, std::size_t vertices) {
    using Way = std::pair<double, Index>;  // its edge's angle, and where it leads
    std::priority_queue<Way, std::vector<Way>, std::greater<>> ways;
    Patch patch;
    start_patch(patch);
    ways.emplace(0, seed);
    while (!ways.empty() && patch.vertices.size() < vertices) {
      const Index f = ways.top().second;
      ways.pop();
      if (face_mark_[f] == mark_) continue;
      add(patch, f);
      for (const auto& [g, e] : graph_.neighbours(f))
        if (face_mark_[g] != mark_ && region_of_face_[g] == none && !is_sharp(e)) ways.emplace(angle_[e], g);
    }
    return patch;
  }

  /// A quantile of the least deviations of neighbourhoods, most of which lie on several surfaces on a coarse mesh; 0 if
  /// there are none.
  template <class Neighbourhood>
  double quantile(double part, const Neighbourhood& neighbourhood_of) {
    constexpr std::size_t trials = 400;
    std::vector<double> deviations;
    const std::size_t faces = graph_.number_of_faces();
    for (std::size_t f = 0; f < faces; f += std::max<std::size_t>(1, faces / trials)) {
      const double deviation = least_deviation(neighbourhood_of(static_cast<Index>(f)));
      if (std::isfinite(deviation)) deviations.push_back(deviation);
    }
    if (deviations.empty()) return 0;
    const auto place = deviations.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(deviations.size()));
    std::nth_element(deviations.begin(), place, deviations.end());
    return *place;
  }

  double least_deviation(const Patch& patch) {
    const Surface_samples& samples = samples_of(patch);
    double least = std::numeric_limits<double>::infinity();
    for (const Surface_type type : analytic_types) {
      const double surplus = static_cast<double>(samples.points.size()) - degrees_of_freedom(type);
      if (surplus < 4) break;
      const auto surface = fit_analytic_surface(type, samples);
      if (!surface) continue;
      least = std::min(least, surface->residual * std::sqrt(static_cast<double>(samples.points.size()) / surplus));
    }
    return least;
  }

  // ---- Surfaces ----

  /// 1 if the surface's normals point out of the solid, -1 if into it.
  double sign_of(const Analytic_surface& surface, const Patch& patch) const {
    constexpr std::size_t enough = 50;
    double sum = 0;
    for (std::size_t i = 0; i < patch.faces.size() && i < enough; ++i) {
      const Index f = patch.faces[i];
      sum += geometry_.area[f] * surface.normal(geometry_.centroid[f]).dot(geometry_.normal[f]);
    }
    return sum < 0 ? -1 : 1;
  }

  bool lies_on(const Analytic_surface& surface, double sign, Index f) const {
    for (const Index v : corners_[f])
      if (!(std::abs(surface.signed_distance(corners_.point(v))) <= tolerance_->largest_distance())) return false;
    const Eigen::Vector3d& n = geometry_.normal[f];
    return n.isZero() || sign * surface.normal(geometry_.centroid[f]).dot(n) > std::cos(tolerance_->normal_angle[f]);
  }

  /// The free faces on a surface that are connected with the seed, until they have so many vertices.
  void flood(Index seed, const Analytic_surface& surface, double sign, std::size_t most_vertices, Patch& patch) {
    start_patch(patch);
    if (!lies_on(surface, sign, seed)) return;
    add(patch, seed);
    for (std::size_t i = 0; i < patch.faces.size() && patch.vertices.size() < most_vertices; ++i)
      for (const auto& [g, e] : graph_.neighbours(patch.faces[i]))
        if (face_mark_[g] != mark_ && region_of_face_[g] == none && !is_barrier_[e] && lies_on(surface, sign, g))
          add(patch, g);
  }

  /// The region of a surface of that type which begins as a given neighbourhood of the seed.
  Region region_of_type(Surface_type type, Index seed, const Patch& start) {
    constexpr int most_rounds = 30;
    constexpr std::size_t everything = std::numeric_limits<std::size_t>::max();
    const auto needed = static_cast<std::size_t>(degrees_of_freedom(type)) + 1;
    Region region;
    if (start.vertices.size() < needed) return region;
    auto surface = fit_analytic_surface(type, samples_of(start), tolerance_->largest_distance());
    if (!surface) return region;
    const Patch* last = &start;
    std::size_t last_size = start.vertices.size(), limit = 2 * last_size;
    for (int round = 0; round < most_rounds; ++round) {
      const double sign = sign_of(*surface, *last);
      flood(seed, *surface, sign, limit, region.patch);
      last = &region.patch;
      const std::size_t size = region.patch.vertices.size();
      if (size < needed) return region;
      const bool is_whole = size < limit;
      if (is_whole && 50 * size <= 51 * last_size) break;  // grows no more
      limit = is_whole ? everything : 3 * std::max(limit, size);
      last_size = size;
      const Surface_samples& samples = samples_of(region.patch);
      surface = type == Surface_type::plane ? fit_analytic_surface(type, samples)
                                            : Least_squares_surface(*surface, samples.points).fit();
      if (!surface) return region;
    }
    region.surface = *surface;
    if (!is_piece_of_free_form(*surface)) region.gain = gain(region);
    return region;
  }

  /// A surface grown on a free form ends where the distance becomes too large; vertices of a true one are exact, unless
  /// there is noise.
  bool is_piece_of_free_form(const Analytic_surface& surface) const {
    return tolerance_->noise == 0 && surface.residual > tolerance_->distance / 3;
  }

  /// The number of vertices explained, each the less the farther it is off, beyond those that determine the surface.
  double gain(const Region& region) const {
    double sum = -degrees_of_freedom(region.surface.type);
    for (const Index v : region.patch.vertices) {
      const double d = region.surface.signed_distance(corners_.point(v)) / tolerance_->largest_distance();
      sum += 1 - d * d;
    }
    return sum;
  }

  /// The region about a face that explains most.
  Region best_region(Index seed, const Pass& pass) {
    const bool is_noisy = tolerance_->noise > 0;  // few vertices mislead then: all sizes are tried
    const std::vector<std::size_t> sizes =
        is_noisy ? std::vector<std::size_t>{18, 54, 162} : std::vector<std::size_t>{7, 10, 12, 36};
    Region best;
    const std::size_t largest = is_noisy ? 0 : hash_of(neighbourhood(seed, sizes.back()));
    if (is_noisy || !has_failed(seed, largest, pass.least_gain)) {
      for (const std::size_t size : sizes) {
        if (size < pass.smallest_start) continue;
        const Patch start = neighbourhood(seed, size);
        improve(best, seed, start, pass.least_gain);
        if (best.gain >= pass.least_gain && !is_noisy) return best;
        if (start.vertices.size() < size) break;
      }
      failures_[seed] = {largest, best.gain};
    }
    if (pass.along_strips) improve(best, seed, flattest_neighbourhood(seed, sizes.front()), pass.least_gain);
    return best;
  }

  /// Where a region ends smoothly, one that begins beyond may hold a part of it and explain more: a ring beside a fillet
  /// and the first row of triangles of the fillet lie on one torus, too.
  void prefer_rivals(Region& region, const Pass& pass) {
    for (Region rival = rival_of(region, pass); rival.gain > region.gain; rival = rival_of(region, pass))
      region = std::move(rival);
  }

  /// A region with more gain that has faces in common with a given one; none if its gain is not larger.
  Region rival_of(const Region& region, const Pass& pass) {
    for (const Index seed : seeds_beyond(region.patch)) {
      Region rival = best_region(seed, pass);
      if (rival.gain <= region.gain) continue;
      mark_faces(region.patch);
      if (std::any_of(rival.patch.faces.begin(), rival.patch.faces.end(),
                      [&](Index f) { return face_mark_[f] == mark_; }))
        return rival;
    }
    return {};
  }

  /// Some of the faces beside a patch, and for each of them one farther away.
  std::vector<Index> seeds_beyond(const Patch& patch) {
    constexpr std::size_t places = 4, reach = 18;
    const std::vector<Index> beside = faces_beside(patch);
    std::vector<Index> seeds;
    for (std::size_t i = 0; i < std::min(places, beside.size()); ++i) {
      const Index near = beside[i * beside.size() / places];
      const std::vector<Index> about = neighbourhood(near, reach).faces;
      mark_faces(patch);
      const Index far = *std::find_if(about.rbegin(), about.rend(), [&](Index f) { return face_mark_[f] != mark_; });
      seeds.push_back(near);
      if (far != near) seeds.push_back(far);
    }
    return seeds;
  }

  /// Whether regions that begin as the same neighbourhood gained too little before.
  bool has_failed(Index seed, std::size_t neighbourhood, double least_gain) const {
    return failures_[seed].gain < least_gain && failures_[seed].neighbourhood == neighbourhood;
  }

  static std::size_t hash_of(const Patch& patch) { return boost::hash_range(patch.faces.begin(), patch.faces.end()); }

  /// Other faces of a region that gained too little would hardly gain more, the less the more of them were tried.
  void expect_no_more(Index seed, const Region& region) {
    const double hardly = 1 + 0.3 * std::pow(0.9, tries_[seed]);
    const double gain = hardly * std::max(region.gain, 0.);
    possible_gain_[seed] = gain;
    for (const Index f : region.patch.faces) {
      possible_gain_[f] = std::min(possible_gain_[f], gain);
      ++tries_[f];
    }
  }

  /// Tries all surfaces that begin as a neighbourhood of the seed; a more complex one must explain noticeably more.
  void improve(Region& best, Index seed, const Patch& start, double least_gain) {
    for (const Surface_type type : analytic_types) {
      if (type != Surface_type::plane && start.vertices.size() < static_cast<std::size_t>(degrees_of_freedom(type)) + 2)
        return;
      Region region = region_of_type(type, seed, start);
      if (region.gain > (best.gain > 0 ? 1.05 * best.gain + 2 : best.gain)) best = std::move(region);
      if (type == Surface_type::plane && best.gain >= least_gain && ends_at_sharp_edges(best.patch)) return;
    }
  }

  bool ends_at_sharp_edges(const Patch& patch) { return faces_beside(patch).empty(); }

  /// The free faces that a patch continues into across edges that are not sharp.
  std::vector<Index> faces_beside(const Patch& patch) {
    mark_faces(patch);
    std::vector<Index> beside;
    for (const Index f : patch.faces)
      for (const auto& [g, e] : graph_.neighbours(f))
        if (face_mark_[g] != mark_ && region_of_face_[g] == none && !is_sharp(e)) beside.push_back(g);
    return beside;
  }

  std::vector<double> signs() const {
    std::vector<double> sums(surfaces_.size(), 0);
    for (Index f = 0; f < graph_.number_of_faces(); ++f)
      if (region_of_face_[f] != none)
        sums[region_of_face_[f]] +=
            geometry_.area[f] * surfaces_[region_of_face_[f]].normal(geometry_.centroid[f]).dot(geometry_.normal[f]);
    for (double& sum : sums) sum = sum < 0 ? -1 : 1;
    return sums;
  }

  /// Distance and angle, as parts of what is allowed.
  double misfit(std::size_t region, double sign, Index f) const {
    const Analytic_surface& surface = surfaces_[region];
    double farthest = 0;
    for (const Index v : corners_[f])
      farthest = std::max(farthest, std::abs(surface.signed_distance(corners_.point(v))));
    double angle = 0;
    if (!geometry_.normal[f].isZero()) {
      const double cosine = sign * surface.normal(geometry_.centroid[f]).dot(geometry_.normal[f]);
      angle = std::acos(std::clamp(cosine, -1., 1.));
    }
    return farthest / tolerance_->largest_distance() + angle / tolerance_->normal_angle[f];
  }

  // ---- Borders ----

  /// Moves each face to the region of a neighbour where it costs least, again and again.
  /// \param cost of a face, in a region or none
  template <class Cost>
  bool move_faces(int most_sweeps, const Cost& cost) {
    bool has_moved = false;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool moves = false;
      for (Index f = 0; f < graph_.number_of_faces(); ++f) {
        const std::size_t own = region_of_face_[f];
        std::size_t best = own;
        double least = cost(f, own);
        for (const auto& [g, e] : graph_.neighbours(f)) {
          const std::size_t other = region_of_face_[g];
          if (other == none || other == own || other == best || is_barrier_[e]) continue;
          const double d = cost(f, other);
          if (d < least - 1e-3) {
            least = d;
            best = other;
          }
        }
        moves |= best != own;
        region_of_face_[f] = best;
      }
      if (!moves) break;
      has_moved = true;
    }
    return has_moved;
  }

  /// Fits each surface to its region.
  void fit_again() {
    constexpr std::size_t enough = 12;
    std::vector<std::vector<Index>> faces(surfaces_.size());
    for (Index f = 0; f < graph_.number_of_faces(); ++f)
      if (region_of_face_[f] != none) faces[region_of_face_[f]].push_back(f);
    Patch patch;
    for (std::size_t region = 0; region < surfaces_.size(); ++region) {
      start_patch(patch);
      for (const Index f : faces[region]) add(patch, f);
      if (patch.vertices.size() < enough) continue;
      Analytic_surface& surface = surfaces_[region];
      const Surface_samples& samples = samples_of(patch);
      const auto fitted = surface.type == Surface_type::plane ? fit_analytic_surface(surface.type, samples)
                                                              : Least_squares_surface(surface, samples.points).fit();
      if (fitted) surface = *fitted;
    }
  }

  static constexpr double unexplained_energy = 3;

  /// How unlikely it is that noise puts a face where it is: the data term of a Potts model.
  double energy(std::size_t region, double sign, Index f) const {
    constexpr double most_squares = 30;  // an outlier is no worse than that
    const Analytic_surface& surface = surfaces_[region];
    double distances = 0, angle = 0;
    for (const Index v : corners_[f]) {
      const double distance = surface.signed_distance(corners_.point(v)) / tolerance_->distance;
      distances += distance * distance;
    }
    if (!geometry_.normal[f].isZero()) {
      const double cosine = sign * surface.normal(geometry_.centroid[f]).dot(geometry_.normal[f]);
      angle = 3 * std::acos(std::clamp(cosine, -1., 1.)) / tolerance_->normal_angle[f];
    }
    return std::min(distances, most_squares) / 4 + std::min(angle * angle, most_squares) / 2;
  }

  /// The length of the border of a face in a region, in mean lengths of its edges.
  double border_energy(std::size_t region, Index f) const {
    double border = 0, all = 0;
    for (const auto& [g, e] : graph_.neighbours(f)) {
      all += geometry_.edge_length[e];
      if (region_of_face_[g] != region) border += geometry_.edge_length[e];
    }
    return all > 0 ? 3 * border / all : 0;
  }

  const Dual_graph& graph_;
  const Face_geometry& geometry_;
  const Face_corners& corners_;
  const std::vector<char>& is_barrier_;
  const Surface_tolerance* tolerance_ = nullptr;
  std::vector<double> angle_;                           // of each edge
  std::vector<std::uint32_t> face_mark_, vertex_mark_;  // what the patch at hand holds has its mark
  std::uint32_t mark_ = 0;
  Surface_samples samples_;
  std::vector<std::size_t> region_of_face_;
  std::vector<Analytic_surface> surfaces_;  // of each region
  std::vector<Failure> failures_;           // by face, without noise
  std::vector<double> possible_gain_;       // of a region about each face, as far as is known
  std::vector<std::uint32_t> tries_;        // by face: regions with it that gained too little
};

}  // namespace RW_segmentation::internal

#endif
