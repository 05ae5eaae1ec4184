// SPDX-License-Identifier: MIT

// Solids whose analytic faces are known: how well they are found, clean and under noise, beside CGAL's segmentation by
// sharp edges, by growing planes and by shape diameters. Some parts of CGAL used here are under the GPL.

#include "../test/designed_surfaces.h"
#include "../test/solids.h"
#include "measurement.h"
#include "mesh_tiles.h"
#include "segmentation_measures.h"
#include "surface_numbers.h"

#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/tiled_surfaces.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/mesh_segmentation.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/Polygon_mesh_processing/region_growing.h>
#else
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_polygon_mesh.h>
#endif

#include <boost/property_map/property_map.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace RW_segmentation;
using namespace measurement;
using Kernel_point = Mesh::Point;
using Labels = std::vector<std::size_t>;

// ---- Solids ----

struct Subject {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::size_t>> faces;
  Labels truth;                                 // of each face
  std::vector<Analytic_surface> surfaces = {};  // of each label, where the numbers are asked for
};

Subject subject_of(const solids::Solid& solid, const std::string& meshing) {
  return {solid.name + meshing, solid.points, solid.faces, solid.label, designed_surfaces(solid)};
}

/// \param only_even no scanner makes meshes like those of a CAD kernel
std::vector<Subject> constructed_solids(double edge_length, bool only_even) {
  std::vector<Subject> subjects;
  for (const solids::Solid& solid : solids::all(solids::even(edge_length)))
    subjects.push_back(subject_of(solid, ".even"));
  if (only_even) return subjects;
  for (const solids::Solid& solid : solids::all(solids::by_kernel())) subjects.push_back(subject_of(solid, ".kernel"));
  return subjects;
}

/// NAME_5k.off and NAME_5k.seg, with one label a line in the order of the triangles.
/// \param has_numbers whether NAME.json tells the numbers of the surfaces
std::vector<Subject> solids_in_folder(const std::filesystem::path& folder, const std::string& suffix,
                                      bool has_numbers) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".off" && name.size() > suffix.size() &&
        name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0)
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Subject> subjects;
  for (std::filesystem::path path : paths) {
    Subject subject;
    subject.name = path.stem().string();
    std::vector<Kernel_point> points;
    if (!CGAL::IO::read_polygon_soup(path.string(), points, subject.faces))
      throw std::runtime_error(path.string() + ": cannot be read");
    for (const Kernel_point& p : points) subject.points.emplace_back(p.x(), p.y(), p.z());
    std::ifstream labels(path.replace_extension(".seg"));
    for (std::size_t label = 0; labels >> label;) subject.truth.push_back(label);
    if (subject.truth.size() != subject.faces.size())
      throw std::runtime_error(path.string() + ": not one label for each face");
    if (has_numbers)
      subject.surfaces = surface_numbers::surfaces_of_design(
          folder / (subject.name.substr(0, subject.name.size() - suffix.size()) + ".json"));
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

/// How subjects are made worse.
struct Damage {
  double noise = 0;         // percent of the diagonal
  bool is_scanned = false;  // with all else that a scanner does
  double step = 0;          // that coordinates are rounded to at last, percent of the diagonal
};

/// \param seed of what is by chance
Subject damaged(const Subject& subject, const Damage& damage, unsigned seed) {
  solids::Solid solid;
  solid.points = subject.points;
  solid.faces = subject.faces;
  solid.label = subject.truth;
  if (damage.is_scanned)
    solid = solids::scanned(solid, damage.noise, seed);
  else if (damage.noise > 0)
    solid = solids::with_noise(std::move(solid), damage.noise, seed);
  if (damage.step > 0) solid = solids::with_rounded_coordinates(std::move(solid), damage.step);
  return {subject.name, std::move(solid.points), std::move(solid.faces), std::move(solid.label), subject.surfaces};
}

/// The mesh of a subject, its faces in order; vertices where the surface touches itself are doubled.
Mesh mesh_of(const Subject& subject) {
  std::vector<Kernel_point> points;
  for (const Eigen::Vector3d& p : subject.points) points.emplace_back(p.x(), p.y(), p.z());
  auto faces = subject.faces;
  namespace PMP = CGAL::Polygon_mesh_processing;
  if (!PMP::is_polygon_soup_a_polygon_mesh(faces)) PMP::orient_polygon_soup(points, faces);
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  if (num_faces(mesh) != subject.truth.size()) throw std::runtime_error(subject.name + ": is no manifold");
  return mesh;
}

// ---- Methods ----

using Label_map =
    boost::iterator_property_map<std::size_t*, boost::property_map<Mesh, boost::face_index_t>::const_type>;
using Method = std::function<void(const Mesh&, Label_map)>;

/// Cuts along edges sharper than an angle; CGAL leaves numbers of the patches from 1.
void by_sharp_edges(const Mesh& input, Label_map labels) {
  constexpr double angle = 20;
  Mesh mesh = input;
  const auto is_sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_sharp", false).first;
  const auto patch = mesh.add_property_map<Mesh::Face_index, int>("f:patch", 0).first;
  CGAL::Polygon_mesh_processing::sharp_edges_segmentation(mesh, angle, is_sharp, patch);
  for (const auto f : mesh.faces()) put(labels, f, static_cast<std::size_t>(get(patch, f)));
}

/// Planes grown from face to face, with CGAL's default angle; distances as parts of the diagonal.
void by_planes(const Mesh& mesh, Label_map labels) {
  constexpr double largest_angle = 25, largest_distance = 0.002;
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const double distance =
      largest_distance * std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
#if CGAL_VERSION_NR >= 1060000000
  CGAL::Polygon_mesh_processing::region_growing_of_planes_on_faces(
      mesh, labels, CGAL::parameters::maximum_distance(distance).maximum_angle(largest_angle));
#else
  namespace Planes = CGAL::Shape_detection::Polygon_mesh;
  using Plane_fit = Planes::Least_squares_plane_fit_region<CGAL::Simple_cartesian<double>, Mesh>;
  Planes::One_ring_neighbor_query<Mesh> neighbours(mesh);
  Plane_fit plane_fit(mesh, distance, largest_angle, 1, mesh.points());
  const auto faces = mesh.faces();
  CGAL::Shape_detection::Region_growing<Mesh::Face_range, Planes::One_ring_neighbor_query<Mesh>, Plane_fit> growing(
      faces, neighbours, plane_fit);
  std::vector<std::vector<std::size_t>> planes;
  growing.detect(std::back_inserter(planes));
  for (std::size_t plane = 0; plane < planes.size(); ++plane)
    for (const std::size_t f : planes[plane])
      put(labels, *(mesh.faces_begin() + static_cast<std::ptrdiff_t>(f)), plane);
#endif
}

void by_shape_diameter(const Mesh& mesh, Label_map labels) {
  std::vector<double> values(num_faces(mesh));
  const auto value_map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  CGAL::sdf_values(mesh, value_map);
  CGAL::segmentation_from_sdf_values(mesh, value_map, labels);
}

/// The mesh cut into eight boxes, segmented tile by tile.
void by_tiles(const Mesh& mesh, Label_map labels) {
  constexpr std::size_t boxes = 8;
  Labels tile = mesh_tiles::cut_by_grid(Dual_mesh_of(mesh), boxes);
  std::vector<std::vector<Mesh::Face_index>> faces;
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh_tiles::cut(mesh, tile, faces));
  const Labels segments = mesh_tiles::of_whole(
      hierarchy.segments(Cost_threshold_stop(Surface_segmentation().stop_cost)(hierarchy.tree)), faces);
  for (const auto f : mesh.faces()) put(labels, f, segments[f]);
}

const std::vector<std::pair<std::string, Method>>& methods() {
  static const std::vector<std::pair<std::string, Method>> all = {
      {"engineering", [](const Mesh& mesh, Label_map labels) { segmentation_into_surfaces(mesh, labels); }},
      {"tiles", by_tiles},
      {"sharp_edges", by_sharp_edges},
      {"planes", by_planes},
      {"sdf", by_shape_diameter},
  };
  return all;
}

// ---- Measures ----

struct Score {
  double error = 0, boundary_error = 0, overlap = 0, segments = 0, true_segments = 0, matched = 0, milliseconds = 0;
  double roughly_matched = 0;
  surface_numbers::Count numbers;
  double stability = 0;  ///< overlap with what is found when the faces are numbered at random
};

double area(const Mesh& mesh, Mesh::Face_index f) {
  const auto h = mesh.halfedge(f);
  const auto &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
             &c = mesh.point(mesh.target(mesh.next(h)));
  return std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2;
}

/// Area-weighted mean over the segments of `a` of the best intersection over union with one of `b`, the same the other
/// way round, and the mean of both. Also the share of the segments of `b` with a fiftieth of the area or more that are
/// matched at 0.9, and roughly at 0.75.
void add_overlap(const Mesh& mesh, const Labels& a, const Labels& b, Score& score) {
  std::map<std::size_t, double> of_a, of_b, best_a, best_b;
  std::map<std::pair<std::size_t, std::size_t>, double> common;
  double total = 0;
  for (const auto f : mesh.faces()) {
    const double share = area(mesh, f);
    of_a[a[f]] += share;
    of_b[b[f]] += share;
    common[{a[f], b[f]}] += share;
    total += share;
  }
  for (const auto& [pair, share] : common) {
    const double ratio = share / (of_a[pair.first] + of_b[pair.second] - share);
    best_a[pair.first] = std::max(best_a[pair.first], ratio);
    best_b[pair.second] = std::max(best_b[pair.second], ratio);
  }
  for (const auto& [label, share] : of_a) score.overlap += best_a[label] * share / total / 2;
  double large = 0, matched = 0, roughly_matched = 0;
  for (const auto& [label, share] : of_b) {
    score.overlap += best_b[label] * share / total / 2;
    if (share < 0.02 * total) continue;
    ++large;
    matched += best_b[label] >= 0.9;
    roughly_matched += best_b[label] >= 0.75;
  }
  score.matched = large > 0 ? matched / large : 1;
  score.roughly_matched = large > 0 ? roughly_matched / large : 1;
  score.segments = static_cast<double>(of_a.size());
  score.true_segments = static_cast<double>(of_b.size());
}

/// Compares the numbers of the surfaces with those of the design, for each segment of it with a fiftieth of the area or
/// more; the segment found for it is that of the best intersection over union.
surface_numbers::Count numbers_of(const Mesh& mesh, Labels labels, const Subject& subject) {
  std::map<std::size_t, double> found_area, true_area;
  std::map<std::size_t, std::map<std::size_t, double>> common;
  double total = 0;
  for (const auto f : mesh.faces()) {
    const double share = area(mesh, f);
    found_area[labels[f]] += share;
    true_area[subject.truth[f]] += share;
    common[subject.truth[f]][labels[f]] += share;
    total += share;
  }
  const auto surfaces =
      segment_surfaces(mesh, Label_map(labels.data(), get(boost::face_index, mesh)), found_area.rbegin()->first + 1);
  surface_numbers::Count count;
  for (const auto& [truth, shares] : common) {
    if (true_area[truth] < 0.02 * total) continue;
    double best = 0;
    std::size_t match = 0;
    for (const auto& [label, share] : shares) {
      const double ratio = share / (found_area[label] + true_area[truth] - share);
      if (ratio > best) match = label;
      best = std::max(best, ratio);
    }
    surface_numbers::add(surfaces[match], subject.surfaces.at(truth), count);
  }
  return count;
}

/// The length of the edges that are a boundary in one segmentation only, as a part of the length of all boundaries.
double boundary_error(const Mesh& mesh, const Labels& a, const Labels& b) {
  double differing = 0, all = 0;
  for (const auto e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const auto h = mesh.halfedge(e);
    const auto f = mesh.face(h), g = mesh.face(mesh.opposite(h));
    const bool in_a = a[f] != a[g], in_b = b[f] != b[g];
    const double length = std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    if (in_a != in_b) differing += length;
    if (in_a || in_b) all += length;
  }
  return all > 0 ? differing / all : 0;
}

Labels labels_by(const Method& method, const Mesh& mesh) {
  Labels labels(num_faces(mesh));
  method(mesh, Label_map(labels.data(), get(boost::face_index, mesh)));
  return labels;
}

/// Seeds are tried in the order of the faces, as far as these have one size: other numbers shift the seeds.
double stability(const Subject& subject, const Method& method, const Mesh& mesh, const Labels& labels) {
  std::vector<std::size_t> order(subject.faces.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Subject shuffled = {subject.name, subject.points, {}, {}};
  for (const std::size_t f : order) {
    shuffled.faces.push_back(subject.faces[f]);
    shuffled.truth.push_back(subject.truth[f]);
  }
  const Labels of_shuffled = labels_by(method, mesh_of(shuffled));
  Labels others(labels.size());
  for (std::size_t i = 0; i < order.size(); ++i) others[order[i]] = of_shuffled[i];
  Score score;
  add_overlap(mesh, labels, others, score);
  return score.overlap;
}

Score score_of(const Subject& subject, const Method& method, bool measures_stability, bool has_numbers) {
  const Mesh mesh = mesh_of(subject);
  Score score;
  const Stopwatch watch;
  const Labels labels = labels_by(method, mesh);
  score.milliseconds = watch.milliseconds();
  if (measures_stability) score.stability = stability(subject, method, mesh, labels);
  score.error = segmentation_measures::Overlaps(labels, subject.truth).rand_index_error();
  score.boundary_error = boundary_error(mesh, labels, subject.truth);
  if (has_numbers) score.numbers = numbers_of(mesh, labels, subject);
  add_overlap(mesh, labels, subject.truth, score);
  return score;
}

// ---- Output ----

Result result_of(const std::string& set, const std::string& method, const Damage& damage,
                 const std::vector<Score>& scores) {
  Score mean;
  double ratio = 0;
  for (const Score& s : scores) {
    const auto n = static_cast<double>(scores.size());
    mean.error += s.error / n;
    mean.boundary_error += s.boundary_error / n;
    mean.overlap += s.overlap / n;
    mean.matched += s.matched / n;
    mean.roughly_matched += s.roughly_matched / n;
    mean.segments += s.segments / n;
    mean.true_segments += s.true_segments / n;
    mean.milliseconds += s.milliseconds / n;
    mean.stability += s.stability / n;
    ratio += s.segments / s.true_segments / n;
    mean.numbers.faces += s.numbers.faces;
    mean.numbers.of_type += s.numbers.of_type;
    mean.numbers.right += s.numbers.right;
    mean.numbers.within_errors += s.numbers.within_errors;
  }
  Result result("engineering");
  result.add("set", set).add("method", method).add("meshes", scores.size()).add("noise", damage.noise);
  if (damage.is_scanned) result.add("scanned", 1);
  if (damage.step > 0) result.add("step", damage.step);
  result.add("error", mean.error).add("boundary_error", mean.boundary_error).add("overlap", mean.overlap);
  result.add("matched", mean.matched)
      .add("roughly_matched", mean.roughly_matched)
      .add("segments", mean.segments)
      .add("true_segments", mean.true_segments);
  result.add("segment_ratio", ratio).add("ms_per_mesh", mean.milliseconds);
  if (mean.stability > 0) result.add("stability", mean.stability);
  if (mean.numbers.faces > 0)
    result.add("radii", mean.numbers.faces)
        .add("of_type", mean.numbers.share(mean.numbers.of_type))
        .add("right_radii", mean.numbers.share(mean.numbers.right))
        .add("within_errors", mean.numbers.share(mean.numbers.within_errors));
  return result;
}

}  // namespace

int main(int argc, char* argv[]) {
  CLI::App app("How well the analytic faces of solids are found");
  std::string data;
  std::vector<std::string> chosen = {"engineering"}, suffixes = {"_5k", "_30k", "_t"};
  std::vector<double> noises = {0};
  double step = 0, edge_length = 0.1;
  unsigned noise_seeds = 1;
  bool is_scanned = false, measures_stability = false, has_numbers = false;
  std::vector<std::string> names;
  for (const auto& [name, method] : methods()) names.push_back(name);
  app.add_option("--data", data, "folder with NAME_5k.off, NAME_5k.seg, ...; default: solids that are made here")
      ->check(CLI::ExistingDirectory);
  app.add_option("--suffix", suffixes, "which files of the folder")->capture_default_str();
  app.add_option("--method", chosen, "what segments, one or several")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_option("--noise", noises, "displace the vertices, in percent of the diagonal, one or several")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--step", step, "round the coordinates to multiples of that many percent of the diagonal")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--noise-seeds", noise_seeds, "how often each solid is displaced or scanned, each time otherwise")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag(
      "--scan", is_scanned,
      "make the meshes scan-like: with the noise, one half twice as fine, smoothed, with holes, and with a fifth of "
      "the triangles at sharp edges missing; constructed ones evenly meshed alone");
  app.add_flag("--stability", measures_stability,
               "also segment each mesh with its faces numbered at random, and tell how far both agree");
  app.add_flag(
      "--numbers", has_numbers,
      "also compare the radii of the faces of 2 percent of the area with those of the design, which NAME.json tells");
  app.add_option("--edge-length", edge_length, "of the evenly meshed solids, whose diagonals are 3 to 5")
      ->check(CLI::Range(0.01, 1.))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  try {
    std::vector<std::pair<std::string, std::vector<Subject>>> sets;
    if (data.empty())
      sets.emplace_back("constructed", constructed_solids(edge_length, is_scanned));
    else
      for (const std::string& suffix : suffixes)
        sets.emplace_back("cad" + suffix, solids_in_folder(data, suffix, has_numbers));
    std::vector<Result> results;
    for (const auto& [set, subjects] : sets)
      for (const std::string& name : chosen)
        for (const double noise : noises) {
          const auto method =
              std::find_if(methods().begin(), methods().end(), [&](const auto& named) { return named.first == name; });
          std::printf("\n%-44s %8s %8s %8s %8s %8s %8s %8s %9s\n", (set + ", " + name).c_str(), "Rand", "boundary",
                      "overlap", "at .9", "at .75", "segments", "true", "ms");
          std::vector<Score> scores;
          const Damage damage = {noise, is_scanned, step};
          const bool is_by_chance = noise > 0 || is_scanned;
          for (const Subject& subject : subjects)
            for (unsigned seed = 1; seed <= (is_by_chance ? noise_seeds : 1); ++seed) {
              const Score s = score_of(damaged(subject, damage, seed), method->second, measures_stability, has_numbers);
              std::printf("%-44s %8.4f %8.4f %8.4f %8.2f %8.2f %8.0f %8.0f %9.1f\n", subject.name.c_str(), s.error,
                          s.boundary_error, s.overlap, s.matched, s.roughly_matched, s.segments, s.true_segments,
                          s.milliseconds);
              std::fflush(stdout);
              scores.push_back(s);
            }
          if (!scores.empty()) results.push_back(result_of(set, name, damage, scores));
        }
    print(results);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_engineering: %s\n", error.what());
    return 1;
  }
}
