// SPDX-License-Identifier: MIT

// How smooth, how true and how fast the boundaries of segments become.

#include "../test/solids.h"
#include "boundary_measures.h"
#include "measurement.h"

#include <RW_segmentation/Geodesic_joining.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/property_map.h>

#include <boost/property_map/function_property_map.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

struct Arguments {
  std::vector<std::string> meshes, data_meshes = {"hand", "elephant", "bear", "fandisk"};
  std::string data;       // folder of the Princeton benchmark
  std::size_t every = 1;  // of its meshes
  std::string joining = "traced";
  std::size_t repeats = 3;
  double edge_length = 0.1;  // of the solids
  double noise = 0.3;        // percent of the diagonal
};

/// The numbers for parts of machines: convex creases count like concave ones, and noise is not expected.
Automatic_segmentation for_machines() {
  Automatic_segmentation policy;
  policy.difference.convex_weight = 1;
  policy.smoothing.radius = 0;
  policy.merge_cost.thickness.samples = 0;
  return policy;
}

std::vector<Boundary_curve<Mesh>> smooth(const Mesh& mesh, const Labels& label, const std::string& joining) {
  return joining == "geodesic" ? smooth_boundaries(mesh, label, {}, Geodesic_joining())
                               : smooth_boundaries(mesh, label, {}, Traced_joining());
}

/// A mesh whose boundaries were smoothed and cut in, and what that took.
struct Refined {
  Mesh mesh;
  Labels label;
  Split_report report;
  Joining_report joining;
  std::size_t curves = 0, curves_left = 0;
  double smooth_ms = 0, split_ms = 0;
};

Refined refine(const Mesh& mesh, const std::string& joining, std::size_t repeats) {
  std::vector<double> smooth_ms, split_ms;
  Refined result;
  for (std::size_t i = 0; i < repeats; ++i) {
    result = {};
    result.mesh = mesh;
    result.label = result.mesh.property_map<Mesh::Face_index, std::size_t>("f:segment").first;
    const Stopwatch smoothing;
    const auto curves = smooth(result.mesh, result.label, joining);
    smooth_ms.push_back(smoothing.milliseconds());
    const Stopwatch splitting;
    result.report = split_along_boundaries(result.mesh, curves, result.label);
    split_ms.push_back(splitting.milliseconds());
    result.curves = curves.size();
    for (const auto& curve : curves) {
      result.curves_left += !curve.is_smoothed;
      result.joining.joints += curve.joining.joints;
      result.joining.failures += curve.joining.failures;
    }
  }
  result.smooth_ms = median(smooth_ms);
  result.split_ms = median(split_ms);
  return result;
}

Segments boundary(const Mesh& mesh, const Labels& label) { return segments_of(mesh, boundary_edges(mesh, label)); }

/// The edges where the surface turns by more than 30 degrees.
Segments creases(const Mesh& mesh) {
  std::vector<bool> is_crease(mesh.num_edges(), false);
  const auto normal = [&](Mesh::Halfedge_index h) {
    return CGAL::normal(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
  };
  for (const auto e : mesh.edges())
    if (!mesh.is_border(e)) {
      const auto h = mesh.halfedge(e);
      is_crease[e] = angle_between(normal(h), normal(mesh.opposite(h))) > CGAL_PI / 6;
    }
  return segments_of(mesh, is_crease);
}

double share_below(const std::vector<double>& values, double limit) {
  const auto below = std::count_if(values.begin(), values.end(), [&](double value) { return value <= limit; });
  return values.empty() ? 1 : static_cast<double>(below) / static_cast<double>(values.size());
}

/// A mesh with segments to smooth.
struct Subject {
  std::string name;
  Mesh mesh;
  Labels label;
  std::size_t segments = 0;
  double segment_ms = 0;
};

Subject segmented(const std::string& name, const Mesh& mesh, const Automatic_segmentation& policy) {
  Subject subject{name, mesh, {}, 0, 0};
  subject.label = subject.mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const Stopwatch segmenting;
  subject.segments = segmentation_via_random_walks(subject.mesh, subject.label, policy);
  subject.segment_ms = segmenting.milliseconds();
  return subject;
}

/// A mesh of the Princeton benchmark with the segments of the first person who cut it.
Subject cut_by_a_person(const std::filesystem::path& folder, const std::string& number) {
  Subject subject{number, read_mesh(folder / "data" / "off" / (number + ".off")), {}, 0, 0};
  subject.label = subject.mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  std::set<std::filesystem::path> people;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "data" / "seg" / "Benchmark" / number))
    people.insert(entry.path());
  if (people.empty()) throw std::runtime_error("nobody has cut mesh " + number);
  std::ifstream file(*people.begin());
  for (const auto f : subject.mesh.faces())
    if (!(file >> subject.label[f])) throw std::runtime_error(people.begin()->string() + ": too few labels");
  std::set<std::size_t> labels;
  for (const auto f : subject.mesh.faces()) labels.insert(subject.label[f]);
  subject.segments = labels.size();
  return subject;
}

/// The numbers of the Princeton benchmark's meshes.
std::vector<std::string> numbers_in(const std::filesystem::path& folder) {
  std::vector<std::string> numbers;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "data" / "off"))
    numbers.push_back(entry.path().stem().string());
  std::sort(numbers.begin(), numbers.end(),
            [](const std::string& a, const std::string& b) { return std::stoul(a) < std::stoul(b); });
  return numbers;
}

/// Measures of one way to join points, over all meshes.
struct Totals {
  std::vector<double> length_ratios, low_angles;
  std::size_t curves = 0, curves_left = 0;
  Joining_report joining;
  double length = 0, jagged_length = 0, ms = 0;  // lengths in diagonals
};

void add(Totals& totals, const Refined& refined, const Turning& jagged, const Turning& smooth, double low_angle,
         double unit) {
  totals.length_ratios.push_back(smooth.length / jagged.length);
  totals.low_angles.push_back(low_angle);
  totals.curves += refined.curves;
  totals.curves_left += refined.curves_left;
  totals.joining.joints += refined.joining.joints;
  totals.joining.failures += refined.joining.failures;
  totals.length += smooth.length / unit;
  totals.jagged_length += jagged.length / unit;
  totals.ms += refined.smooth_ms;
}

void measure(const Subject& subject, const std::string& joining, std::size_t repeats, Totals& totals,
             std::vector<Result>& results) {
  const auto& [name, mesh, label, segments, segment_ms] = subject;
  const Refined refined = refine(mesh, joining, repeats);

  const Turning jagged = turning(mesh, boundary_edges(mesh, label));
  const Turning smooth = turning(refined.mesh, boundary_edges(refined.mesh, refined.label));
  const Segments before = boundary(mesh, label), after = boundary(refined.mesh, refined.label);
  const double edge = mean_edge_length(mesh);
  const auto spread = points_on(after, edge / 10);
  const auto displacement = before.empty() ? std::vector<double>{0} : distances(spread, before);
  const Segments sharp = creases(mesh);
  const double crease_share = sharp.empty() ? 0 : share_below(distances(spread, sharp), edge / 2);
  constexpr double low = 0.01;  // share of the new faces
  const double low_angle = quantile(smallest_angles(refined.mesh, mesh.number_of_faces()), low);
  if (jagged.length > 0) add(totals, refined, jagged, smooth, low_angle, diagonal(mesh));

  std::printf(
      "%-12s %-8s %7u faces %3zu segments %3zu curves (%zu left)  turning %.1f -> %.1f (on the surface %.1f -> %.1f)"
      "  length x %.3f  moved %.2f edges, %.2f %%  %zu of %zu joints failed\n",
      name.c_str(), joining.c_str(), mesh.number_of_faces(), segments, refined.curves, refined.curves_left,
      jagged.in_space, smooth.in_space, jagged.on_surface, smooth.on_surface, smooth.length / jagged.length,
      maximum(displacement) / edge, 100 * maximum(displacement) / diagonal(mesh), refined.joining.failures,
      refined.joining.joints);
  Result& result = results.emplace_back("boundaries");
  result.add("mesh", name).add("joining", joining).add("faces", mesh.number_of_faces()).add("segments", segments);
  result.add("curves", refined.curves).add("curves_left", refined.curves_left);
  result.add("crease_share", crease_share).add("turning_ratio", smooth.on_surface / jagged.on_surface);
  result.add("space_turning_ratio", smooth.in_space / jagged.in_space);
  result.add("turning_per_edge_before", jagged.on_surface / jagged.length * edge);
  result.add("turning_per_edge", smooth.on_surface / smooth.length * edge);
  result.add("length_ratio", smooth.length / jagged.length).add("moved_edges", maximum(displacement) / edge);
  result.add("moved_percent", 100 * maximum(displacement) / diagonal(mesh));
  result.add("faces_added", refined.report.faces_added);
  result.add("least_angle_before", quantile(smallest_angles(mesh, 0), 0));
  result.add("least_angle", quantile(smallest_angles(refined.mesh, 0), 0)).add("low_new_angle", low_angle);
  result.add("joints", refined.joining.joints).add("failures", refined.joining.failures);
  result.add("segment_ms", segment_ms).add("smooth_ms", refined.smooth_ms).add("split_ms", refined.split_ms);
  result.add("ms", refined.smooth_ms + refined.split_ms);
}

/// Measures one subject after the other, and tells of all of them together.
class Comparison {
 public:
  Comparison(const Arguments& arguments, std::vector<Result>& results)
      : repeats_(arguments.repeats), results_(results) {
    if (arguments.joining != "geodesic") totals_["traced"];
    if (arguments.joining != "traced") totals_["geodesic"];
  }

  void operator()(const Subject& subject) {
    for (auto& [joining, totals] : totals_) measure(subject, joining, repeats_, totals, results_);
  }

  void tell(const std::string& set) const {
    for (const auto& [joining, totals] : totals_) {
      if (totals.length_ratios.empty()) continue;
      const double median_angle = median(totals.low_angles);
      std::printf(
          "%-12s %-8s %zu meshes: length x %.5f (%.4f diagonals), %.0f ms, angle %.2f degrees, %zu of %zu joints "
          "failed, %zu of %zu curves left\n",
          set.c_str(), joining.c_str(), totals.length_ratios.size(), totals.length / totals.jagged_length,
          totals.length, totals.ms, median_angle, totals.joining.failures, totals.joining.joints, totals.curves_left,
          totals.curves);
      Result& result = results_.emplace_back("joinings");
      result.add("set", set).add("joining", joining).add("meshes", totals.length_ratios.size());
      result.add("length_ratio", totals.length / totals.jagged_length).add("diagonals", totals.length);
      result.add("low_new_angle", median_angle).add("smooth_ms", totals.ms).add("joints", totals.joining.joints);
      result.add("failures", totals.joining.failures).add("curves", totals.curves);
      result.add("curves_left", totals.curves_left);
    }
  }

 private:
  std::size_t repeats_;
  std::vector<Result>& results_;
  std::map<std::string, Totals> totals_;  // by the way to join
};

// ---- Solids whose joints are known ----

Mesh mesh_of(const solids::Solid& solid) {
  Mesh mesh;
  for (const auto& p : solid.points) mesh.add_vertex(Mesh::Point(p.x(), p.y(), p.z()));
  for (const auto& face : solid.faces) {
    std::vector<Mesh::Vertex_index> corners;
    for (const std::size_t corner : face) corners.emplace_back(static_cast<Mesh::size_type>(corner));
    mesh.add_face(corners);
  }
  Labels map = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  for (const auto f : mesh.faces()) map[f] = solid.label[f];
  return mesh;
}

/// The faces that are cut off from the largest piece of their segment.
std::vector<Mesh::Face_index> cut_off_faces(const Mesh& mesh, const Labels& label) {
  std::vector<bool> is_boundary = boundary_edges(mesh, label);
  std::vector<std::size_t> piece(mesh.number_of_faces());
  const std::size_t pieces = CGAL::Polygon_mesh_processing::connected_components(
      mesh, CGAL::make_property_map(piece),
      CGAL::parameters::edge_is_constrained_map(
          boost::make_function_property_map<Mesh::Edge_index, bool>([&](auto e) { return is_boundary[e]; })));
  std::vector<std::size_t> size(pieces, 0);
  for (const std::size_t p : piece) ++size[p];
  std::map<std::size_t, std::size_t> largest;  // piece of a label
  for (const auto f : mesh.faces()) {
    const auto [place, is_new] = largest.try_emplace(label[f], piece[f]);
    if (size[piece[f]] > size[place->second]) place->second = piece[f];
  }
  std::vector<Mesh::Face_index> result;
  for (const auto f : mesh.faces())
    if (piece[f] != largest[label[f]]) result.push_back(f);
  return result;
}

/// Moves the boundaries by a face here and there: every second face at a joint, chosen by chance, goes to the other
/// side. Where that would tear a segment into pieces it is taken back.
void make_jagged(const Mesh& mesh, const Labels& label) {
  std::mt19937 random(1);
  std::vector<std::size_t> true_label;
  for (const auto f : mesh.faces()) true_label.push_back(label[f]);
  const auto for_each_beside = [&](Mesh::Face_index f, const auto& visit) {
    for (const auto h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh)) visit(mesh.face(mesh.opposite(h)));
  };
  for (const auto f : mesh.faces())
    for_each_beside(f, [&](Mesh::Face_index g) {
      if (true_label[g] != true_label[f] && random() % 2 == 0) label[f] = true_label[g];
    });
  for (auto faces = cut_off_faces(mesh, label); !faces.empty(); faces = cut_off_faces(mesh, label))
    for (const auto f : faces) {
      label[f] = true_label[f];
      for_each_beside(f, [&](Mesh::Face_index g) { label[g] = true_label[g]; });
    }
}

void measure_joints(const solids::Solid& solid, const Arguments& arguments, std::vector<Result>& results) {
  const Mesh exact = mesh_of(solid);
  const Labels true_label = exact.property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const Segments joint = boundary(exact, true_label);
  const Mesh mesh = mesh_of(solids::with_noise(solid, arguments.noise));
  const Labels label = mesh.property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  make_jagged(mesh, label);
  const Refined refined = refine(mesh, arguments.joining, 1);

  const double edge = mean_edge_length(exact);
  const double before = mean(distances(points_on(boundary(mesh, label), edge / 10), joint)) / edge;
  const double after = mean(distances(points_on(boundary(refined.mesh, refined.label), edge / 10), joint)) / edge;
  const Turning jagged = turning(mesh, boundary_edges(mesh, label));
  const Turning smooth = turning(refined.mesh, boundary_edges(refined.mesh, refined.label));
  std::printf("%-18s %7u faces %3zu curves (%zu left)  distance from the joint %.3f -> %.3f edges  turning x %.2f\n",
              solid.name.c_str(), mesh.number_of_faces(), refined.curves, refined.curves_left, before, after,
              smooth.on_surface / jagged.on_surface);
  Result& result = results.emplace_back("boundaries");
  result.add("solid", solid.name).add("faces", mesh.number_of_faces()).add("noise_percent", arguments.noise);
  result.add("curves", refined.curves).add("curves_left", refined.curves_left);
  result.add("joint_distance_before", before).add("joint_distance", after).add("joint_ratio", after / before);
  result.add("turning_ratio", smooth.on_surface / jagged.on_surface).add("faces_added", refined.report.faces_added);
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Smooths the boundaries of automatic segments and cuts them into the mesh; measures how much they turn, how far "
      "they move, which share of them lies on creases, and the time. The fandisk is segmented as a part of a machine. "
      "On constructed solids with noise it measures how far boundaries, made jagged by chance, lie from the joints.");
  app.add_option("MESH", arguments.meshes, "Mesh files of your own, instead of the data meshes and the solids")
      ->check(CLI::ExistingFile);
  app.add_option("--data-meshes", arguments.data_meshes, "Of CGAL; none for the solids alone")
      ->delimiter(',')
      ->expected(0, -1)
      ->capture_default_str();
  app.add_option(
         "--data", arguments.data,
         "Folder with the layout of the Princeton Segmentation Benchmark: its meshes instead, with the segments of "
         "the first person who cut each")
      ->check(CLI::ExistingDirectory);
  app.add_option("--every", arguments.every, "Measure every how manyth of them")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--joining", arguments.joining,
                 "How points of boundaries are joined; solids are measured with the first")
      ->check(CLI::IsMember({"traced", "geodesic", "both"}))
      ->capture_default_str();
  app.add_option("--repeats", arguments.repeats, "Runs whose median time counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--edge-length", arguments.edge_length, "Of the solids, whose diagonals are 3 to 5; 0 for none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--noise", arguments.noise, "On the solids, percent of the diagonal")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<Result> results;
  const auto compare = [&](const std::string& set, const auto& measure_all) {
    Comparison comparison(arguments, results);
    measure_all(comparison);
    comparison.tell(set);
  };
  if (!arguments.data.empty())
    compare("princeton", [&](Comparison& comparison) {
      const std::vector<std::string> numbers = numbers_in(arguments.data);
      for (std::size_t i = 0; i < numbers.size(); i += arguments.every)
        comparison(cut_by_a_person(arguments.data, numbers[i]));
    });
  if (!arguments.meshes.empty())
    compare("meshes", [&](Comparison& comparison) {
      for (const std::string& path : arguments.meshes)
        comparison(segmented(std::filesystem::path(path).stem().string(), read_mesh(path), {}));
    });
  if (arguments.data.empty() && arguments.meshes.empty()) {
    compare("cgal", [&](Comparison& comparison) {
      for (const std::string& name : arguments.data_meshes)
        comparison(segmented(name, read_mesh(data_mesh(name + ".off")),
                             name == "fandisk" ? for_machines() : Automatic_segmentation()));
    });
    if (arguments.edge_length > 0)
      for (const solids::Solid& solid : solids::all(solids::even(arguments.edge_length)))
        measure_joints(solid, arguments, results);
  }
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_boundaries: " << error.what() << '\n';
  return 1;
}
