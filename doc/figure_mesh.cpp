// SPDX-License-Identifier: MIT

// Coloured meshes for those pictures of the manual that need more than segment_mesh offers: see scripts/make-figures.
//
//   figure_mesh MESH OUT.ply --parameter tension --value 0.5    segments with one parameter changed
//   figure_mesh MESH OUT.ply --seed 12 --seed 7 --shift 0.1     segments of seeds that were moved, and the seeds as balls

#include "../examples/mesh_files.h"
#include "../examples/segment_mesh/Oriented_mesh.h"
#include "../examples/segment_mesh/segment_colors.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/split_along_boundaries.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/boost/graph/generators.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

namespace RW = RW_segmentation;
using segment_mesh::Mesh;
using segment_mesh::Point;
using Face = Mesh::Face_index;
using Segment_map = Mesh::Property_map<Face, std::size_t>;
using Color_map = Mesh::Property_map<Face, mesh_files::Color>;
using Vector = CGAL::Kernel_traits<Point>::Kernel::Vector_3;

double diagonal_of(const Mesh& mesh) {
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::hypot(box.x_span(), box.y_span(), box.z_span());
}

Point centroid(const Mesh& mesh, Face f) {
  const auto h = mesh.halfedge(f);
  return CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
}

// ---- One parameter changed ----

/// The numbers that can be changed, with the library's defaults. `increase` has none.
struct Numbers {
  RW::Automatic_segmentation automatic;
  RW::Surface_segmentation engineering;
  RW::Boundary_smoothing boundary;
  double increase = 0, threshold = 0.4, decrease = 0.6, radius = 3;
};

Segment_map new_segments(Mesh& mesh) { return mesh.add_property_map<Face, std::size_t>("f:segment").first; }

void paint_segments(const Mesh& mesh, const Segment_map& segments, Color_map colors) {
  std::vector<std::size_t> ids(mesh.number_of_faces());
  for (const Face f : mesh.faces()) ids[f] = segments[f];
  const std::size_t number = *std::max_element(ids.begin(), ids.end()) + 1;
  const auto palette = segment_mesh::segment_colors(mesh, ids, number);
  for (const Face f : mesh.faces()) colors[f] = palette[ids[f]];
}

template <class Policy>
void paint_segmentation(Mesh& mesh, const Policy& policy, Color_map colors) {
  const Segment_map segments = new_segments(mesh);
  RW::segmentation_via_random_walks(mesh, segments, policy);
  paint_segments(mesh, segments, colors);
}

void automatically(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  paint_segmentation(mesh, numbers.automatic, colors);
}

void part_of_machine(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  const Segment_map segments = new_segments(mesh);
  RW::segmentation_into_surfaces(mesh, segments, numbers.engineering);
  paint_segments(mesh, segments, colors);
}

/// By walks over clusters, which meshes of this size do not need.
void automatically_reduced(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  RW::Automatic_segmentation policy = numbers.automatic;
  policy.reduction.largest_direct = 0;
  paint_segmentation(mesh, policy, colors);
}

void automatically_to_jump(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  const Segment_map segments = new_segments(mesh);
  RW::hierarchy_via_random_walks(mesh).segments(RW::Cost_jump_stop(numbers.increase), segments);
  paint_segments(mesh, segments, colors);
}

void smooth_boundaries(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  const Segment_map segments = new_segments(mesh);
  RW::segmentation_via_random_walks(mesh, segments);
  RW::split_along_boundaries(mesh, RW::smooth_boundaries(mesh, segments, numbers.boundary), segments);
  paint_segments(mesh, segments, colors);
}

/// As `segment_mesh --coarse` does.
template <class Stop>
void coarsely(Mesh& mesh, const Stop& stop, Color_map colors) {
  const auto normals = mesh.add_property_map<Face, Vector>("f:smoothed_normal").first;
  RW::smoothed_face_normals(mesh, normals);
  const RW::Dihedral_difference turn(mesh, normals, 0.5, RW::Dihedral_measure::angle);
  const RW::Dihedral_difference concavity(mesh, normals, 0, RW::Dihedral_measure::angle);
  std::vector<Face> seeds;
  RW::coarse_seeds(mesh, turn, stop, std::back_inserter(seeds));
  const Segment_map segments = new_segments(mesh);
  RW::segmentation_from_seeds(mesh, RW::Conductance(mesh, concavity), seeds, segments);
  paint_segments(mesh, segments, colors);
}

void coarsely_by_threshold(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  coarsely(mesh, RW::Separation_threshold_stop(numbers.threshold), colors);
}

void coarsely_by_decrease(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  coarsely(mesh, RW::Separation_decrease_stop(numbers.decrease), colors);
}

/// From grey, no difference to any neighbour, to red.
void curvature_difference(Mesh& mesh, const Numbers& numbers, Color_map colors) {
  const RW::Curvature_difference difference(mesh, RW::Ball_radius::in_edge_lengths(numbers.radius));
  for (const Face f : mesh.faces()) {
    double largest = 0;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      if (!mesh.is_border(mesh.edge(h))) largest = std::max(largest, get(difference, mesh.edge(h)));
    const double share = largest / (largest + 2);
    const auto mix = [&](double none, double much) {
      return static_cast<std::uint8_t>(std::lround(none + share * (much - none)));
    };
    colors[f] = {mix(210, 200), mix(210, 0), mix(210, 0)};
  }
}

struct Parameter {
  void (*set)(Numbers&, double);
  void (*paint)(Mesh&, const Numbers&, Color_map);
};

std::size_t whole(double value) { return static_cast<std::size_t>(std::llround(value)); }

const std::map<std::string, Parameter>& parameters() {
  static const std::map<std::string, Parameter> all = {
      {"stop_cost", {[](Numbers& n, double x) { n.automatic.stop = RW::Cost_threshold_stop(x); }, automatically}},
      {"ordinary_difference",
       {[](Numbers& n, double x) { n.automatic.difference.ordinary_difference = x; }, automatically}},
      {"normal_weight",
       {[](Numbers& n, double x) { n.automatic.seeding.sampling = RW::Farthest_point_sampling(x); }, automatically}},
      {"samples", {[](Numbers& n, double x) { n.automatic.merge_cost.thickness.samples = whole(x); }, automatically}},
      {"rays", {[](Numbers& n, double x) { n.automatic.merge_cost.thickness.rays = whole(x); }, automatically}},
      {"cone_angle", {[](Numbers& n, double x) { n.automatic.merge_cost.thickness.cone_angle = x; }, automatically}},
      {"noise_angle", {[](Numbers& n, double x) { n.automatic.smoothing.noise_angle = x; }, automatically}},
      {"largest_widening", {[](Numbers& n, double x) { n.automatic.smoothing.largest_widening = x; }, automatically}},
      {"heavy_noise", {[](Numbers& n, double x) { n.automatic.smoothing.heavy_noise = x; }, automatically}},
      {"cluster_steps",
       {[](Numbers& n, double x) { n.automatic.reduction.cluster_steps = whole(x); }, automatically_reduced}},
      {"largest_difference",
       {[](Numbers& n, double x) { n.automatic.reduction.largest_difference = x; }, automatically_reduced}},
      {"band", {[](Numbers& n, double x) { n.automatic.reduction.band = whole(x); }, automatically_reduced}},
      {"increase", {[](Numbers& n, double x) { n.increase = x; }, automatically_to_jump}},
      {"noise", {[](Numbers& n, double x) { n.engineering.noise = x; }, part_of_machine}},
      {"radius", {[](Numbers& n, double x) { n.radius = x; }, curvature_difference}},
      {"threshold", {[](Numbers& n, double x) { n.threshold = x; }, coarsely_by_threshold}},
      {"decrease", {[](Numbers& n, double x) { n.decrease = x; }, coarsely_by_decrease}},
      {"length", {[](Numbers& n, double x) { n.boundary.length = x; }, smooth_boundaries}},
      {"tension", {[](Numbers& n, double x) { n.boundary.tension = x; }, smooth_boundaries}},
      {"feature_weight", {[](Numbers& n, double x) { n.boundary.feature_weight = x; }, smooth_boundaries}},
      {"crease_angle", {[](Numbers& n, double x) { n.boundary.crease_angle = x; }, smooth_boundaries}},
      {"largest_displacement", {[](Numbers& n, double x) { n.boundary.largest_displacement = x; }, smooth_boundaries}},
      {"steps", {[](Numbers& n, double x) { n.boundary.steps = whole(x); }, smooth_boundaries}},
  };
  return all;
}

/// Displaces the vertices at random.
/// \param deviation the standard deviation of each coordinate, in parts of the diagonal
void add_noise(Mesh& mesh, double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, deviation * diagonal_of(mesh));
  for (const auto v : mesh.vertices()) {
    const double x = noise(random), y = noise(random), z = noise(random);
    mesh.point(v) = mesh.point(v) + Vector(x, y, z);
  }
}

// ---- Seeds that move ----

/// Each seed moves to a face of its segment at random, not farther than `shift` in parts of the diagonal.
std::vector<Face> shifted(const Mesh& mesh, const std::vector<Face>& seeds, const Segment_map& segments, double shift) {
  const double distance = shift * diagonal_of(mesh);
  std::mt19937 random(1);
  std::vector<Face> result;
  for (const Face seed : seeds) {
    std::vector<Face> near;
    for (const Face f : mesh.faces())
      if (segments[f] == segments[seed] &&
          CGAL::squared_distance(centroid(mesh, f), centroid(mesh, seed)) <= distance * distance)
        near.push_back(f);
    result.push_back(near[random() % near.size()]);
  }
  return result;
}

void add_ball(Mesh& mesh, const Point& centre, double radius, Color_map colors) {
  const std::size_t faces = mesh.number_of_faces();
  CGAL::make_icosahedron(mesh, centre, radius);
  for (std::size_t f = faces; f < mesh.number_of_faces(); ++f)
    colors[Face(static_cast<Mesh::size_type>(f))] = {0, 0, 0};
}

/// The segments of seeds that were moved, as segment_mesh makes them.
void paint_shifted_seeds(Mesh& mesh, const std::vector<Face>& seeds, double shift, Color_map colors) {
  const auto normals = mesh.add_property_map<Face, Vector>("f:smoothed_normal").first;
  RW::smoothed_face_normals(mesh, normals);
  const RW::Dihedral_difference difference(mesh, normals, 0.02, RW::Dihedral_measure::angle);
  const RW::Conductance conductance(mesh, difference);
  const Segment_map segments = new_segments(mesh);
  RW::segmentation_from_seeds(mesh, conductance, seeds, segments);
  const std::vector<Face> moved = shifted(mesh, seeds, segments, shift);
  RW::segmentation_from_seeds(mesh, conductance, moved, segments);
  paint_segments(mesh, segments, colors);
  std::vector<Point> centres;
  for (const Face f : moved) centres.push_back(centroid(mesh, f));
  const double radius = 0.015 * diagonal_of(mesh);
  for (const Point& centre : centres) add_ball(mesh, centre, radius, colors);
}

void write(const std::string& path, const Mesh& mesh, const Color_map& colors) {
  mesh_files::Polygon_soup soup;
  soup.points.assign(mesh.points().begin(), mesh.points().end());
  std::vector<mesh_files::Color> face_colors;
  for (const Face f : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) soup.corners.push_back(v.idx());
    soup.end_face();
    face_colors.push_back(colors[f]);
  }
  mesh_files::Output_file file(path);
  mesh_files::write_ply(file, soup, mesh_files::colors_of_faces(face_colors),
                        std::vector<std::size_t>(face_colors.size()));
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Coloured meshes for the pictures of the manual");
  std::string input, output, parameter;
  double value = 0, noise = 0, shift = 0;
  std::vector<std::uint32_t> seeds;
  app.add_option("mesh", input, "mesh of triangles")->required()->check(CLI::ExistingFile);
  app.add_option("output", output, "PLY file to write")->required();
  app.add_option("--parameter", parameter, "what is changed")->check(CLI::IsMember(&parameters()));
  app.add_option("--value", value, "its value")->needs("--parameter");
  app.add_option("--noise", noise, "displace the vertices first, in parts of the diagonal");
  app.add_option("--seed", seeds, "a seed face")->excludes("--parameter");
  app.add_option("--shift", shift, "how far seeds may move, in parts of the diagonal")->needs("--seed");
  CLI11_PARSE(app, argc, argv);
  try {
    Mesh mesh = segment_mesh::oriented_mesh(mesh_files::read_mesh(input), {}).mesh;
    if (noise > 0) add_noise(mesh, noise);
    const Color_map colors = mesh.add_property_map<Face, mesh_files::Color>("f:painted").first;
    Numbers numbers;
    if (!seeds.empty()) {
      paint_shifted_seeds(mesh, {seeds.begin(), seeds.end()}, shift, colors);
    } else if (const auto found = parameters().find(parameter); found != parameters().end()) {
      found->second.set(numbers, value);
      found->second.paint(mesh, numbers, colors);
    } else {
      automatically(mesh, numbers, colors);
    }
    write(output, mesh, colors);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "figure_mesh: %s\n", error.what());
    return 1;
  }
}
