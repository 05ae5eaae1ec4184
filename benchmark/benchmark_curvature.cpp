// SPDX-License-Identifier: MIT

// How right the curvatures from balls are on surfaces in closed form, clean and with noise, beside CGAL's jet fitting to
// the vertices in the same balls; and what they cost. Jet fitting is GPL.

#include "measurement.h"

#include <RW_segmentation/integral_invariant_curvatures.h>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <CLI/CLI.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using Eigen::Vector3d;
using measurement::Mesh;

namespace {

using Point = Mesh::Point;
using Kernel = CGAL::Kernel_traits<Point>::Kernel;
using Face = Mesh::Face_index;
using Curvatures = std::array<double, 2>;  // the larger one first
constexpr double pi = 3.14159265358979323846;

Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

// ---- Surfaces in closed form ----

struct Surface {
  std::string name;
  Mesh mesh;
  std::function<Curvatures(const Vector3d&)> curvatures;
  std::function<double(const Vector3d&)> distance_to_border = [](const Vector3d&) { return 1e9; };
};

/// A sphere of 20 * 4^levels triangles.
Mesh sphere(unsigned levels) {
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1);
  for (unsigned level = 0; level < levels; ++level) {
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
    for (const auto v : mesh.vertices()) {
      const Vector3d p = vector(mesh.point(v)).normalized();
      mesh.point(v) = Point(p.x(), p.y(), p.z());
    }
  }
  return mesh;
}

/// A grid of `columns` by `rows` squares, each of two triangles, closed in the first direction, and if `closed` in the
/// second; `at(u, v)` for u, v in [0, 1].
template <class At>
Mesh grid(std::size_t columns, std::size_t rows, bool closed, const At& at) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  const std::size_t lines = rows + (closed ? 0 : 1);
  for (std::size_t j = 0; j < lines; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const Vector3d p =
          at(static_cast<double>(i) / static_cast<double>(columns), static_cast<double>(j) / static_cast<double>(rows));
      vertices.push_back(mesh.add_vertex(Point(p.x(), p.y(), p.z())));
    }
  const auto vertex = [&](std::size_t i, std::size_t j) { return vertices[j % lines * columns + i % columns]; };
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

Surface unit_sphere(unsigned levels) {
  return {"sphere", sphere(levels), [](const Vector3d&) { return Curvatures{1, 1}; }};
}

Surface ellipsoid(unsigned levels) {
  const Eigen::Array3d axes(1.3, 1, 0.7);
  Surface surface{"ellipsoid", sphere(levels), [axes](const Vector3d& x) {
                    const Eigen::Array3d squares = axes.square();
                    const Eigen::Array3d p = x.array() / std::sqrt((x.array().square() / squares).sum());
                    const double w = (p.square() / squares.square()).sum(), product = squares.prod();
                    const double gaussian = 1 / (product * w * w);
                    const double mean = (squares.sum() - p.square().sum()) / (2 * product * std::pow(w, 1.5));
                    const double half = std::sqrt(std::max(0., mean * mean - gaussian));
                    return Curvatures{mean + half, mean - half};
                  }};
  for (const auto v : surface.mesh.vertices()) {
    const Eigen::Array3d p = axes * vector(surface.mesh.point(v)).array();
    surface.mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
  return surface;
}

Surface cylinder(std::size_t around) {
  constexpr double height = 3;
  const auto rows = static_cast<std::size_t>(height * static_cast<double>(around) / (2 * pi));
  const auto at = [](double u, double v) { return Vector3d(std::cos(2 * pi * u), std::sin(2 * pi * u), height * v); };
  return {"cylinder", grid(around, rows, false, at),
          [](const Vector3d&) {
            return Curvatures{1, 0};
          },
          [](const Vector3d& p) { return std::min(p.z(), height - p.z()); }};
}

Surface torus(std::size_t around) {
  const auto at = [](double u, double v) {
    const double distance = 2 + std::cos(2 * pi * v);
    return Vector3d(distance * std::cos(2 * pi * u), distance * std::sin(2 * pi * u), std::sin(2 * pi * v));
  };
  return {"torus", grid(around, around / 2, true, at), [](const Vector3d& p) {
            const double out = std::hypot(p.x(), p.y()) - 2, cosine = out / std::hypot(out, p.z());
            return Curvatures{1, cosine / (2 + cosine)};
          }};
}

/// Each vertex displaced by a normal deviate of this standard deviation in each coordinate.
Mesh with_noise(Mesh mesh, double deviation) {
  if (deviation == 0) return mesh;
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  for (const auto v : mesh.vertices()) {
    Point& p = mesh.point(v);
    p = p + deviation * Kernel::Vector_3{noise(random), noise(random), noise(random)};
  }
  return mesh;
}

double diagonal(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto v : mesh.vertices()) box.extend(vector(mesh.point(v)));
  return box.diagonal().norm();
}

Vector3d centre(const Mesh& mesh, Face f) {
  Vector3d sum = Vector3d::Zero();
  for (const auto v : vertices_around_face(mesh.halfedge(f), mesh)) sum += vector(mesh.point(v));
  return sum / 3;
}

// ---- Jet fitting in the same balls ----

/// The vertices in a ball round the centre of a face that hang together with the face in it, or of all triangles that
/// meet the ball; the centre comes first.
std::vector<Point> neighbourhood(const Mesh& mesh, Face face, double radius, bool of_all_triangles) {
  const Vector3d p = centre(mesh, face);
  std::set<Face> seen = {face};
  std::vector<Face> queue = {face};
  std::set<Mesh::Vertex_index> vertices;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const auto h : halfedges_around_face(mesh.halfedge(queue[i]), mesh)) {
      const Vector3d a = vector(mesh.point(mesh.source(h))) - p, side = vector(mesh.point(mesh.target(h))) - p - a;
      const double t = std::clamp(-a.dot(side) / side.squaredNorm(), 0., 1.);
      if (of_all_triangles || a.norm() <= radius) vertices.insert(mesh.source(h));
      if ((a + t * side).norm() > radius) continue;
      const Face next = mesh.face(mesh.opposite(h));
      if (next != Mesh::null_face() && seen.insert(next).second) queue.push_back(next);
    }
  std::vector<Point> points = {Point(p.x(), p.y(), p.z())};
  for (const auto v : vertices) points.push_back(mesh.point(v));
  return points;
}

/// By a quadratic; needs six points.
Curvatures by_jet_fitting(const std::vector<Point>& points, const Vector3d& outward) {
  CGAL::Monge_via_jet_fitting<Kernel> fitting;
  auto monge = fitting(points.begin(), points.end(), 2, 2);
  monge.comply_wrt_given_normal(Kernel::Vector_3(outward.x(), outward.y(), outward.z()));
  return {-monge.principal_curvatures(1), -monge.principal_curvatures(0)};
}

// ---- Errors ----

class Mean {
 public:
  void add(const Curvatures& found, const Curvatures& exact) {
    sum_ += std::hypot(found[0] - exact[0], found[1] - exact[1]) / std::hypot(exact[0], exact[1]);
    ++number_;
  }
  double value() const { return number_ == 0 ? std::nan("") : sum_ / static_cast<double>(number_); }

 private:
  double sum_ = 0;
  std::size_t number_ = 0;
};

double processor_milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

measurement::Result measure(const Surface& surface, double noise, double radius, std::size_t jets) {
  Mesh mesh = with_noise(surface.mesh, noise / 100 * diagonal(surface.mesh));
  const auto curvatures = mesh.add_property_map<Face, Surface_curvatures>("f:curvatures").first;
  const double start = processor_milliseconds();
  const Curvature_report report =
      integral_invariant_curvatures<CGAL::Sequential_tag>(mesh, curvatures, Ball_radius::in_edge_lengths(radius));
  const double us_per_face = 1e3 * (processor_milliseconds() - start) / static_cast<double>(mesh.number_of_faces());

  Mean error, error_where_jets, jet_error, wide_jet_error;
  const std::size_t stride = std::max<std::size_t>(1, mesh.number_of_faces() / jets);
  for (const Face f : mesh.faces()) {
    const Vector3d p = centre(surface.mesh, f);
    if (surface.distance_to_border(p) < 1.1 * report.radius) continue;
    const Curvatures exact = surface.curvatures(p);
    const Curvatures found = {curvatures[f].max_curvature, curvatures[f].min_curvature};
    error.add(found, exact);
    if (f.idx() % stride != 0) continue;
    const auto points = neighbourhood(mesh, f, report.radius, false);
    if (points.size() >= 7) {
      error_where_jets.add(found, exact);
      jet_error.add(by_jet_fitting(points, curvatures[f].normal), exact);
    }
    wide_jet_error.add(by_jet_fitting(neighbourhood(mesh, f, report.radius, true), curvatures[f].normal), exact);
  }
  std::printf("%-10s %8zu %8.1f %8.1f %12.4f %12.4f %12.4f %12.1f\n", surface.name.c_str(),
              static_cast<std::size_t>(mesh.number_of_faces()), noise, radius, error.value(), jet_error.value(),
              wide_jet_error.value(), us_per_face);
  std::fflush(stdout);
  measurement::Result result("curvature");
  result.add("shape", surface.name).add("faces", mesh.number_of_faces()).add("radius", radius).add("noise", noise);
  result.add("error", error.value()).add("error_where_jets", error_where_jets.value());
  result.add("jet_error", jet_error.value()).add("wide_jet_error", wide_jet_error.value());
  result.add("us_per_face", us_per_face);
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<double> radii = {2, 3, 4, 6, 8}, noises = {0, 0.1, 0.3};
  std::vector<std::string> shapes = {"sphere", "cylinder", "torus", "ellipsoid"};
  unsigned levels = 5;
  std::size_t jets = 2000;
  CLI::App app(
      "Measures curvatures from balls on surfaces in closed form, beside CGAL's jet fitting of a quadratic to the "
      "vertices in the same balls (jet) and to the vertices of all triangles that meet them (wide jet). The error is "
      "|(k1, k2) - exact| / |exact|, on average over the faces; jets are fitted at a sample of them. Time is that of "
      "one "
      "processor.");
  app.add_option("--radii", radii, "Radii in mean edge lengths")->capture_default_str();
  app.add_option("--noises", noises, "Standard deviations of noise in percent of the diagonal")->capture_default_str();
  app.add_option("--shapes", shapes, "sphere, cylinder, torus, ellipsoid")->capture_default_str();
  app.add_option("--levels", levels, "20 * 4^levels faces on a sphere, about as many on the others")
      ->capture_default_str();
  app.add_option("--jets", jets, "About how many jets are fitted for a line")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const auto around = static_cast<std::size_t>(4.5 * std::pow(2., levels));
  std::vector<measurement::Result> results;
  std::printf("%-10s %8s %8s %8s %12s %12s %12s %12s\n", "shape", "faces", "noise %", "radius", "error", "jet",
              "wide jet", "us per face");
  for (const std::string& shape : shapes) {
    const Surface surface = shape == "sphere"     ? unit_sphere(levels)
                            : shape == "cylinder" ? cylinder(around)
                            : shape == "torus"    ? torus(around)
                                                  : ellipsoid(levels);
    for (const double noise : noises)
      for (const double radius : radii) results.push_back(measure(surface, noise, radius, jets));
  }
  measurement::print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_curvature: " << error.what() << '\n';
  return 1;
}
