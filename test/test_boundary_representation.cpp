// SPDX-License-Identifier: MIT

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "designed_surfaces.h"
#include "meshes.h"
#include "solids.h"

// Open CASCADE has a macro Handle(...), and OpenMesh a class: those headers come first.
#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/boundary_representation.h>
#include <RW_segmentation/internal/brep/Curved_triangle.h>
#include <RW_segmentation/internal/brep/Edge_curve.h>
#include <RW_segmentation/internal/brep/Face_integrals.h>
#include <RW_segmentation/internal/brep/Shape_distances.h>
#include <RW_segmentation/internal/brep/kernel_errors.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Status.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;

namespace {

constexpr double pi = solids::half_turn;

Boundary_representation represented(const solids::Solid& solid, const std::vector<Analytic_surface>& surfaces,
                                    double scale = 1) {
  const auto mesh = meshes::surface_mesh({solid.points, solid.faces});
  const auto ids = boost::make_iterator_property_map(solid.label.begin(), get(boost::face_index, mesh));
  return boundary_representation(mesh, ids, surfaces, scale);
}

Boundary_representation represented(const solids::Solid& solid) { return represented(solid, designed_surfaces(solid)); }

/// The segments that have a face of the type of their surface.
std::set<std::size_t> segments_on_their_surfaces(const Boundary_representation& result,
                                                 const std::vector<Analytic_surface>& surfaces) {
  std::set<std::size_t> segments;
  for (const Boundary_face& face : result.faces)
    if (face.type == surfaces[face.segment].type) segments.insert(face.segment);
  return segments;
}

/// Two solids as one mesh.
solids::Solid joined(solids::Solid a, const solids::Solid& b) {
  const std::size_t points = a.points.size(), surfaces = a.surfaces.size();
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto face : b.faces) {
    for (std::size_t& v : face) v += points;
    a.faces.push_back(face);
  }
  for (const std::size_t label : b.label) a.label.push_back(label + surfaces);
  a.surfaces.insert(a.surfaces.end(), b.surfaces.begin(), b.surfaces.end());
  return a;
}

/// `solids::box()` in another size, its centre elsewhere.
solids::Solid box_of_size(double size, const solids::Point& centre) {
  solids::Solid box = solids::box(solids::by_kernel());
  for (solids::Point& p : box.points) p = size * p + centre;
  for (solids::Surface& s : box.surfaces) s.point = size * s.point + centre;
  return box;
}

void turn_inside_out(solids::Solid& solid) {
  for (auto& face : solid.faces) std::swap(face[1], face[2]);
}

/// A ring, all of it on one torus.
solids::Solid ring(double radius, double tube_radius) {
  solids::Builder builder("ring");
  const std::size_t label = builder.add(solids::torus({0, 0, 0}, solids::Point::UnitZ(), radius, tube_radius));
  solids::revolve(builder, label, 48, 24,
                  solids::arc({radius, 0, 0}, tube_radius * solids::Point::UnitX(),
                              tube_radius * solids::Point::UnitZ(), 0, 2 * pi));
  return std::move(builder).solid();
}

/// A box of sides 2, 2 and 1 whose top is a wave.
solids::Solid box_with_wave() {
  solids::Builder builder("wave");
  constexpr std::size_t steps = 24;
  const auto height = [](double x, double y) { return 1 + 0.2 * std::sin(2 * x) * std::cos(1.5 * y); };
  const auto at = [&](double x, double y, double share) { return solids::Point(x, y, share * height(x, y)); };
  const auto plane = [&](const solids::Point& p, const solids::Point& n) { return builder.add(solids::plane(p, n)); };
  builder.grid(plane({0, 0, 0}, {0, 0, -1}), steps, steps,
               [&](double u, double v) { return at(2 * v - 1, 2 * u - 1, 0); });
  builder.grid(plane({0, 0, 1}, {0, 0, 1}), steps, steps,
               [&](double u, double v) { return at(2 * u - 1, 2 * v - 1, 1); });
  builder.grid(plane({1, 0, 0}, {1, 0, 0}), steps, 4, [&](double u, double v) { return at(1, 2 * u - 1, v); });
  builder.grid(plane({-1, 0, 0}, {-1, 0, 0}), steps, 4, [&](double u, double v) { return at(-1, 1 - 2 * u, v); });
  builder.grid(plane({0, 1, 0}, {0, 1, 0}), steps, 4, [&](double u, double v) { return at(1 - 2 * u, 1, v); });
  builder.grid(plane({0, -1, 0}, {0, -1, 0}), steps, 4, [&](double u, double v) { return at(2 * u - 1, -1, v); });
  return std::move(builder).solid();
}

/// Some faces with the label of a face that they share a corner with, so that borders have teeth.
solids::Solid with_teeth(solids::Solid solid, double share_of_faces, unsigned seed) {
  std::vector<std::vector<std::size_t>> labels_at(solid.points.size());
  for (std::size_t f = 0; f < solid.faces.size(); ++f)
    for (const std::size_t v : solid.faces[f]) labels_at[v].push_back(solid.label[f]);
  std::mt19937 random(seed);
  std::bernoulli_distribution is_taken(share_of_faces);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const auto& labels = labels_at[solid.faces[f][0]];
    if (is_taken(random)) solid.label[f] = labels[random() % labels.size()];
  }
  return solid;
}

/// The first two corners of a face joined by two edges, the first of which has no length.
solids::Solid with_vertex_twice(solids::Solid solid, std::size_t face) {
  const std::size_t a = solid.faces[face][0], b = solid.faces[face][1], middle = solid.points.size();
  solid.points.push_back(solid.points[a]);
  for (std::size_t f = 0, faces = solid.faces.size(); f < faces; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = solid.faces[f][k], to = solid.faces[f][(k + 1) % 3], apex = solid.faces[f][(k + 2) % 3];
      if (std::minmax(from, to) != std::minmax(a, b)) continue;
      solid.faces[f] = {from, middle, apex};
      solid.faces.push_back({middle, to, apex});
      solid.label.push_back(solid.label[f]);
      break;
    }
  return solid;
}

/// A face folded: five in its place, of which an edge has no length and cannot be none, since four faces would meet in one edge
/// then.
solids::Solid with_fold(solids::Solid solid, std::size_t face) {
  const std::size_t a = solid.faces[face][0], b = solid.faces[face][1], c = solid.faces[face][2];
  const std::size_t d = solid.points.size(), e = d + 1;
  solid.points.push_back(solid.points[a]);
  solid.points.push_back((solid.points[a] + solid.points[b] + solid.points[c]) / 3);
  solid.faces[face] = {b, c, d};
  solid.faces.insert(solid.faces.end(), {{c, a, d}, {a, b, e}, {b, d, e}, {d, a, e}});
  solid.label.insert(solid.label.end(), 4, solid.label[face]);
  return solid;
}

/// Surfaces moved by up to a length along each axis, and with radii that are off by up to as large a share.
std::vector<Analytic_surface> moved_aside(std::vector<Analytic_surface> surfaces, double length, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(-length, length);
  for (Analytic_surface& surface : surfaces) {
    surface.radius *= 1 + way(random);
    for (double& x : surface.point) x += way(random);
  }
  return surfaces;
}

/// A cylinder of radius 1 and height 2 with a cone on it or, where `height` is negative, a pit of that shape in it.
solids::Solid with_pointed_cone(double height) {
  solids::Builder builder("pointed cone");
  constexpr std::size_t around = 24;
  const double rim = 2;
  solids::flat_disc(builder, solids::by_kernel(), around, 1, 0, false);
  solids::revolve(builder, builder.add(solids::cylinder({0, 0, 0}, solids::Point::UnitZ(), 1)), around, 1,
                  solids::line({1, 0, 0}, {1, 0, rim}));
  const solids::Point apex(0, 0, rim + height), axis(0, 0, height > 0 ? -1 : 1);
  solids::revolve(builder, builder.add(solids::cone(apex, axis, std::atan(1 / std::abs(height)))), around, 3,
                  solids::line({1, 0, rim}, apex));
  return std::move(builder).solid();
}

void expect_relative(double value, double expected, double error) {
  EXPECT_NEAR(value, expected, error * std::abs(expected));
}

}  // namespace

TEST(Boundary_representation, HasAValidFaceOnEachSurfaceOfASolid) {
  for (const auto& meshing : {solids::even(0.25), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) {
      SCOPED_TRACE(solid.name + (meshing.is_even ? ", even" : ", by a kernel"));
      const auto surfaces = designed_surfaces(solid);
      const Boundary_representation result = represented(solid, surfaces);
      EXPECT_EQ(result.defect(), "");
      EXPECT_EQ(internal::brep::first_error(result.shape), "");
      EXPECT_EQ(result.shape.ShapeType(), TopAbs_SOLID);
      EXPECT_EQ(result.number_of_triangles(), 0U);
      EXPECT_EQ(result.number_of_faces(Surface_type::free_form), 0U);
      EXPECT_EQ(segments_on_their_surfaces(result, surfaces).size(), surfaces.size());
      for (const Boundary_face& face : result.faces) {
        EXPECT_EQ(face.type, surfaces[face.segment].type);
        EXPECT_LE(face.tolerance, 1e-3 * solid.diagonal());
      }
    }
}

TEST(Boundary_representation, OfABoxIsTheBox) {
  const Boundary_representation result = represented(solids::box(solids::even(0.3)));
  EXPECT_EQ(result.faces.size(), 6U);
  EXPECT_EQ(result.report.edges, 12U);
  expect_relative(result.report.volume, 6, 1e-12);
  expect_relative(result.report.area, 22, 1e-12);
}

TEST(Boundary_representation, HasTheAreaAndTheVolumeOfTheShapeAndNotOfTheChords) {
  for (const auto& meshing : {solids::even(0.3), solids::by_kernel()}) {
    const double r = 0.6, length = 2;
    const Boundary_representation capsule = represented(solids::capsule(meshing));
    expect_relative(capsule.report.area, 2 * pi * r * length + 4 * pi * r * r, 1e-5);
    expect_relative(capsule.report.volume, pi * r * r * length + 4 * pi * r * r * r / 3, 1e-5);
    EXPECT_LT(capsule.report.mesh_volume, 0.999 * capsule.report.volume);

    const double a = 2, b = 3, c = 1.5, round = 0.3;
    const Boundary_representation box = represented(solids::rounded_box(meshing));
    expect_relative(box.report.area,
                    2 * (a * b + b * c + c * a) + 2 * pi * round * (a + b + c) + 4 * pi * round * round, 1e-5);
    expect_relative(box.report.volume,
                    a * b * c + 2 * round * (a * b + b * c + c * a) + pi * round * round * (a + b + c) +
                        4 * pi * round * round * round / 3,
                    1e-5);
  }
}

TEST(Boundary_representation, CutsWhatClosesRoundItselfIntoFacesWithoutSeams) {
  const double radius = 1.2, tube_radius = 0.4;
  const Boundary_representation result = represented(ring(radius, tube_radius));
  EXPECT_EQ(result.defect(), "");
  EXPECT_GE(result.number_of_faces(Surface_type::torus), 4U);
  EXPECT_EQ(result.number_of_faces(Surface_type::torus), result.faces.size());
  expect_relative(result.report.area, 4 * pi * pi * radius * tube_radius, 1e-5);
  expect_relative(result.report.volume, 2 * pi * pi * radius * tube_radius * tube_radius, 1e-5);
}

TEST(Boundary_representation, HasTheTipOfACone) {
  for (const double height : {1., -1., -0.3}) {
    SCOPED_TRACE(height);
    const Boundary_representation result = represented(with_pointed_cone(height));
    EXPECT_EQ(result.defect(), "");
    EXPECT_EQ(result.number_of_faces(Surface_type::cone), 2U);
    EXPECT_EQ(result.number_of_triangles(), 0U);
    expect_relative(result.report.volume, 2 * pi + pi * height / 3, 1e-9);
  }
}

TEST(Boundary_representation, FitsASurfaceToAFreeForm) {
  const solids::Solid solid = box_with_wave();
  std::vector<Analytic_surface> surfaces = designed_surfaces(solid);
  surfaces[1] = Analytic_surface();
  const Boundary_representation result = represented(solid, surfaces);
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.faces.size(), 6U);
  EXPECT_EQ(result.number_of_faces(Surface_type::free_form), 1U);
  for (const Boundary_face& face : result.faces) EXPECT_LE(face.distance_of_mesh, 1e-4);
  // The integral of the wave over the square is 0.
  expect_relative(result.report.volume, 4, 1e-4);
}

TEST(EdgeCurve, KeepsSidesStraightThatGoOverIntoArcs) {
  using internal::brep::Point;
  constexpr double length = 6, radius = 1, turn = 1;  // two lines, and an arc of four chords between them
  std::vector<Point> points = {Point(-length, 0, 0)};
  for (const double angle : {0., turn / 4, turn / 2, 3 * turn / 4, turn})
    points.emplace_back(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0);
  points.push_back(points.back() + length * Point(std::cos(turn), std::sin(turn), 0));
  const auto swing = [&](const std::vector<Point>& passed) {  // away from the first line
    const internal::brep::Edge_curve curve = internal::brep::curve_through(passed, 2 * length);
    double largest = 0;
    for (int i = 0; i <= 1000; ++i)
      if (const Point p = curve.at_share(i / 1000.); p.x() < 0) largest = std::max(largest, std::abs(p.y()));
    return largest;
  };
  EXPECT_GT(swing(points), 0.05 * length);
  EXPECT_LT(swing(internal::brep::with_points_on_long_sides(points)), 0.002 * length);
}

TEST(EdgeCurve, TakesEvenSidesAsTheyAre) {
  using internal::brep::Point;
  const std::vector<Point> points = {Point(0, 0, 0), Point(1, 0, 0), Point(2.5, 1, 0), Point(3, 2.5, 1)};
  EXPECT_EQ(internal::brep::with_points_on_long_sides(points), points);
}

TEST(CurvedTriangle, IsCloserToASphereThanItsChords) {
  using internal::brep::Point;
  const std::array<Point, 3> corners = {Point(1, 0, 0), Point(std::cos(0.3), std::sin(0.3), 0),
                                        Point(std::cos(0.2), 0, std::sin(0.2))};
  const internal::brep::Curved_triangle triangle(corners, corners);
  for (const auto& [a, b, c] :
       {std::array{0.5, 0.5, 0.}, std::array{1. / 3, 1. / 3, 1. / 3}, std::array{0.1, 0.2, 0.7}}) {
    const double sagitta = 1 - Point(a * corners[0] + b * corners[1] + c * corners[2]).norm();
    EXPECT_LT(std::abs(1 - triangle.at(a, b, c).norm()), 0.1 * sagitta);
  }
  EXPECT_EQ(triangle.at(0, 1, 0), corners[1]);
}

TEST(CurvedTriangle, IsFlatWhereItsNormalsAreItsOwn) {
  using internal::brep::Point;
  const std::array<Point, 3> corners = {Point(0, 0, 1), Point(3, 0, 1), Point(1, 2, 1)};
  const internal::brep::Curved_triangle triangle(corners, {Point::UnitZ(), Point::UnitZ(), Point::UnitZ()});
  const Point middle = (corners[0] + corners[1] + corners[2]) / 3;
  EXPECT_LT((triangle.at(1. / 3, 1. / 3, 1. / 3) - middle).norm(), 1e-15);
}

using internal::brep::Face_integrals;
using internal::brep::integrals_of;

/// The part of a surface between four parameters.
TopoDS_Face part_of(const Handle(Geom_Surface) & surface, double u0, double u1, double v0, double v1) {
  return BRepBuilderAPI_MakeFace(surface, u0, u1, v0, v1, 1e-7);
}

/// Surfaces of revolution in a frame that is not that of the space.
std::vector<Handle(Geom_Surface)> surfaces_of_revolution() {
  const gp_Ax3 frame(gp_Pnt(0.5, -1, 2), gp_Dir(1, 2, 2), gp_Dir(2, 1, -2));
  return {new Geom_CylindricalSurface(frame, 1.5), new Geom_ConicalSurface(frame, 0.4, 2),
          new Geom_SphericalSurface(frame, 1.5), new Geom_ToroidalSurface(frame, 2, 0.7)};
}

TEST(FaceIntegrals, AreThoseOfSpheresAndToriFromWhereverTheyAreSeen) {
  const double r = 1.5, major = 2, minor = 0.7;
  const TopoDS_Face sphere = part_of(surfaces_of_revolution()[2], 0, 2 * pi, -pi / 2, pi / 2);
  const TopoDS_Face torus = part_of(surfaces_of_revolution()[3], 0, 2 * pi, 0, 2 * pi);
  for (const internal::brep::Point& apex : {internal::brep::Point(0.5, -1, 2), {-3, 0, 4}}) {
    expect_relative(integrals_of(sphere, apex).area, 4 * pi * r * r, 1e-7);
    expect_relative(integrals_of(sphere, apex).volume, 4 * pi * r * r * r / 3, 1e-7);
    expect_relative(integrals_of(torus, apex).area, 4 * pi * pi * major * minor, 1e-7);
    expect_relative(integrals_of(torus, apex).volume, 2 * pi * pi * major * minor * minor, 1e-7);
    expect_relative(integrals_of(TopoDS::Face(torus.Reversed()), apex).volume, -2 * pi * pi * major * minor * minor,
                    1e-7);
  }
}

TEST(FaceIntegrals, AreThoseOfTheSplineThatASurfaceIs) {
  const internal::brep::Point apex(0.3, 0.1, -0.2);
  for (const Handle(Geom_Surface) & surface : surfaces_of_revolution()) {
    const Handle(Geom_Surface) part = new Geom_RectangularTrimmedSurface(surface, 0.3, 4, -0.5, 1.2);
    const Handle(Geom_Surface) spline = GeomConvert::SurfaceToBSplineSurface(part);
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    spline->Bounds(u0, u1, v0, v1);
    const Face_integrals expected = integrals_of(part_of(surface, 0.3, 4, -0.5, 1.2), apex);
    const Face_integrals found = integrals_of(part_of(spline, u0, u1, v0, v1), apex);
    expect_relative(found.area, expected.area, 1e-6);
    expect_relative(found.volume, expected.volume, 1e-6);
  }
}

/// A border of many knots, which may pass through as many points of a circle.
TopoDS_Wire spline_round(double x, double radius, std::size_t points) {
  std::vector<internal::brep::Point> circle;
  for (std::size_t i = 0; i <= points; ++i) {
    const double angle = 2 * pi * double(i) / double(points);
    circle.emplace_back(x + radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  const internal::brep::Edge_curve curve = internal::brep::spline_through(circle, 1);
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve.curve).Edge());
}

TEST(FaceIntegrals, TakeBordersOfManyKnotsAsTheyAre) {
  const gp_Pln plane(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  BRepBuilderAPI_MakeFace disc(plane, spline_round(0, 1, 300));
  expect_relative(integrals_of(disc, {0, 0, -3}).area, pi, 1e-7);
  expect_relative(integrals_of(disc, {5, 7, -3}).volume, pi, 1e-7);
  disc.Add(TopoDS::Wire(spline_round(0.2, 0.5, 300).Reversed()));
  expect_relative(integrals_of(disc, {0, 0, 0}).area, 0.75 * pi, 1e-7);
}

TEST(BorderPolygon, HoldsWhatIsInTheFaceButNotInItsHoles) {
  const gp_Pln plane(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  BRepBuilderAPI_MakeFace disc(plane, spline_round(0, 1, 40));
  disc.Add(TopoDS::Wire(spline_round(0.2, 0.5, 40).Reversed()));
  const internal::brep::Border_polygon border(disc);
  EXPECT_TRUE(border.contains({-0.9, 0}));
  EXPECT_TRUE(border.contains({0.8, 0}));
  EXPECT_TRUE(border.contains({0.2, 0.6}));
  EXPECT_FALSE(border.contains({0.2, 0.4}));
  EXPECT_FALSE(border.contains({-0.8, 0.8}));
  EXPECT_FALSE(border.contains({1.1, 0}));
}

TEST(Boundary_representation, OfAMeshWithABorderIsAShell) {
  solids::Solid solid = solids::stepped_shaft(solids::even(0.4));
  for (std::size_t f = solid.faces.size(); f-- > 0;)
    if (solid.label[f] == 0) {
      solid.faces.erase(solid.faces.begin() + static_cast<std::ptrdiff_t>(f));
      solid.label.erase(solid.label.begin() + static_cast<std::ptrdiff_t>(f));
    }
  const Boundary_representation result = represented(solid);
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.shape.ShapeType(), TopAbs_SHELL);
  EXPECT_EQ(result.report.open_shells, 1U);
  EXPECT_EQ(result.report.solids, 0U);
}

TEST(Boundary_representation, HasASolidForEachComponentAndVoidsInThem) {
  solids::Solid hole = box_of_size(0.3, {0.2, 0.1, 0});
  turn_inside_out(hole);
  const solids::Solid solid = joined(joined(hole, solids::box(solids::by_kernel())), box_of_size(0.5, {5, 0, 0}));
  const Boundary_representation result = represented(solid);
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.shape.ShapeType(), TopAbs_COMPOUND);
  EXPECT_EQ(result.report.solids, 2U);
  EXPECT_EQ(result.report.voids, 1U);
  expect_relative(result.report.volume, 6 - 6 * 0.027 + 6 * 0.125, 1e-12);
}

TEST(Boundary_representation, HasTheCylinderWhoseFacetsWereCut) {
  const meshes::Shape cut = meshes::with_pits(meshes::prism(24), 24, 2);
  meshes::Shape triangles{cut.points, {}};
  for (const auto& face : cut.faces)
    for (std::size_t i = 2; i < face.size(); ++i) triangles.faces.push_back({face[0], face[i - 1], face[i]});
  const auto mesh = meshes::surface_mesh(triangles);
  std::vector<std::size_t> segment(triangles.faces.size());
  const auto ids = boost::make_iterator_property_map(segment.begin(), get(boost::face_index, mesh));
  const std::size_t segments = segmentation_into_surfaces(mesh, ids);
  EXPECT_EQ(segments, 3U + 12U * 5U);  // and the planes of twelve pits
  const auto result = boundary_representation(mesh, ids, segment_surfaces(mesh, ids, segments));
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.number_of_triangles(), 0U);
  EXPECT_EQ(result.number_of_faces(Surface_type::plane), segments - 1);
  EXPECT_GE(result.number_of_faces(Surface_type::cylinder), 1U);
}

TEST(Boundary_representation, OfASmallSolidBesideALargeOneIsThatOfTheSolidAlone) {
  const solids::Meshing meshing = solids::by_kernel();
  for (const solids::Solid& solid : {solids::capsule(meshing), solids::flange(meshing), solids::pipe_elbow(meshing),
                                     solids::cone_on_cylinder(meshing)}) {
    SCOPED_TRACE(solid.name);
    const double size = 300 * solid.diagonal();
    const Boundary_representation alone = represented(solid);
    const Boundary_representation both = represented(joined(solid, box_of_size(size, {2 * size, 0, 0})));
    EXPECT_EQ(both.defect(), "");
    ASSERT_EQ(both.faces.size(), alone.faces.size() + 6);
    double area = 0;
    for (std::size_t i = 0; i < alone.faces.size(); ++i) area += both.faces[i].area;
    expect_relative(area, alone.report.area, 1e-9);
  }
}

TEST(Boundary_representation, TurnsASolidThatIsInsideOut) {
  solids::Solid solid = solids::box(solids::by_kernel());
  turn_inside_out(solid);
  const Boundary_representation result = represented(solid);
  EXPECT_EQ(result.defect(), "");
  expect_relative(result.report.volume, 6, 1e-12);
}

TEST(Boundary_representation, DoesNotForceASurfaceOnTrianglesThatAreNotOnIt) {
  const solids::Solid solid = solids::stepped_shaft(solids::even(0.4));
  for (const Surface_type wrong : analytic_types) {
    SCOPED_TRACE(name_of(wrong));
    std::vector<Analytic_surface> surfaces = designed_surfaces(solid);
    surfaces[2].type = wrong;  // a cylinder
    surfaces[2].half_angle = 0.3;
    surfaces[2].tube_radius = 0.2;
    const Boundary_representation result = represented(solid, surfaces);
    EXPECT_EQ(result.defect(), "");
    expect_relative(result.report.volume, result.report.mesh_volume, 0.03);
  }
}

TEST(Boundary_representation, CutsOffTeethOfABorderBetweenTwoSurfaces) {
  for (const solids::Solid& solid :
       {solids::stepped_shaft(solids::even(0.25)), solids::pipe_elbow(solids::even(0.25))}) {
    const Boundary_report design = represented(solid).report;
    for (unsigned seed = 1; seed < 3; ++seed) {
      SCOPED_TRACE(solid.name + ", seed " + std::to_string(seed));
      const Boundary_representation result = represented(with_teeth(solid, 0.1, seed));
      EXPECT_EQ(result.defect(), "");
      // Closer to the design than the mesh with its chords.
      EXPECT_LT(std::abs(result.report.volume - design.volume), std::abs(design.mesh_volume - design.volume));
    }
  }
}

TEST(Boundary_representation, IsThatOfTheMeshWhateverItsSegmentsAre) {
  const solids::Solid shaft = solids::stepped_shaft(solids::even(0.25));
  const Boundary_representation result =
      represented(with_teeth(shaft, 0.3, 1), moved_aside(designed_surfaces(shaft), 0.01, 1));
  EXPECT_EQ(result.defect(), "");
  expect_relative(result.report.volume, result.report.mesh_volume, 0.05);
  // Faces were refused for several reasons, and made again in all ways.
  EXPECT_GE(result.report.refusals.size(), 4U);
  EXPECT_GT(result.number_of_faces(Surface_type::free_form), 0U);
  EXPECT_GT(result.number_of_triangles(), 0U);
}

TEST(Boundary_representation, HasNoEdgesWithoutLength) {
  solids::Solid solid = solids::box(solids::by_kernel());
  const std::size_t faces = solid.faces.size();
  for (std::size_t f = 0; f < faces; f += 5) solid = with_vertex_twice(std::move(solid), f);
  std::iota(solid.label.begin(), solid.label.end(), std::size_t(0));
  const Boundary_representation result = represented(solid, std::vector<Analytic_surface>(solid.faces.size()));
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.faces.size(), faces);
  expect_relative(result.report.volume, 6, 1e-12);
}

TEST(Boundary_representation, IsNotClosedWhereNoFacesCanBeMade) {
  constexpr std::size_t wave = 1;  // which has a surface that is never fitted, since edges fail before
  solids::Solid folded = with_fold(box_with_wave(), 0);
  std::vector<Analytic_surface> surfaces = designed_surfaces(folded);
  surfaces[wave] = Analytic_surface();
  for (std::size_t& label : folded.label) {
    if (label == wave) continue;
    label = surfaces.size();
    surfaces.emplace_back();
  }
  const Boundary_representation result = represented(folded, surfaces);
  EXPECT_FALSE(result.report.is_closed);
  EXPECT_EQ(result.defect(), "it is not closed");
}

TEST(KernelErrors, HaveWordsOrTheirNumber) {
  std::set<std::string> words;
  for (int status = BRepCheck_NoError + 1; status <= BRepCheck_CheckFail; ++status) {
    const std::string name = internal::brep::name_of(static_cast<BRepCheck_Status>(status));
    if (name.find(std::to_string(status)) == std::string::npos) words.insert(name);
  }
  EXPECT_EQ(words.count(""), 0U);
  EXPECT_EQ(words.size(), 8U);
}

TEST(Boundary_representation, IsScaled) {
  const solids::Solid solid = solids::flange(solids::by_kernel());
  const Boundary_representation one = represented(solid), inches = represented(solid, designed_surfaces(solid), 25.4);
  EXPECT_EQ(inches.defect(), "");
  EXPECT_EQ(inches.faces.size(), one.faces.size());
  expect_relative(inches.report.volume, 25.4 * 25.4 * 25.4 * one.report.volume, 1e-6);
  expect_relative(inches.report.mesh_area, 25.4 * 25.4 * one.report.mesh_area, 1e-12);
}

TEST(Boundary_representation, TakesPolygons) {
  const auto mesh = meshes::surface_mesh({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
                                          {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});
  std::vector<std::size_t> ids = {0, 1, 2, 3, 4};
  const std::vector<Analytic_surface> free_forms(5);
  const Boundary_representation result = boundary_representation(
      mesh, boost::make_iterator_property_map(ids.begin(), get(boost::face_index, mesh)), free_forms);
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.number_of_faces(Surface_type::plane), 5U);
  expect_relative(result.report.volume, 1. / 3, 1e-12);
}

/// A boundary representation of polygons, each on its own plane.
Boundary_representation of_polygons(const meshes::Shape& polygons) {
  const auto mesh = meshes::surface_mesh(polygons);
  std::vector<std::size_t> ids(mesh.number_of_faces());
  std::iota(ids.begin(), ids.end(), std::size_t(0));
  const auto id_map = boost::make_iterator_property_map(ids.begin(), get(boost::face_index, mesh));
  return boundary_representation(mesh, id_map, std::vector<Analytic_surface>(ids.size()));
}

TEST(Boundary_representation, TakesPolygonsThatAreNotConvex) {
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  constexpr std::size_t n = 6;
  for (std::size_t first = 0; first < n; ++first) {
    SCOPED_TRACE(first);
    meshes::Shape prism;
    for (const double z : {0., 1.})
      for (std::size_t i = 0; i < n; ++i)
        prism.points.emplace_back(outline[(first + i) % n][0], outline[(first + i) % n][1], z);
    prism.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (std::size_t i = 0; i < n; ++i) prism.faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    const Boundary_representation result = of_polygons(prism);
    EXPECT_EQ(result.defect(), "");
    EXPECT_EQ(result.faces.size(), 8U);
    expect_relative(result.report.mesh_area, 14, 1e-12);
    expect_relative(result.report.area, 14, 1e-12);
  }
}

TEST(Boundary_representation, TakesPolygonsWithACornerWithinASide) {
  const Boundary_representation result =
      of_polygons({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}, {1, 0, 1}},
                   {{3, 2, 1, 0}, {4, 8, 5, 6, 7}, {5, 8, 4, 0, 1}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}});
  EXPECT_EQ(result.defect(), "");
  EXPECT_EQ(result.faces.size(), 6U);
  expect_relative(result.report.volume, 2, 1e-12);
}

TEST(Boundary_representation, KeepsToTheCornersOfABorder) {
  for (const std::size_t steps : {1U, 2U, 3U, 10U}) {
    SCOPED_TRACE(steps);
    meshes::Shape sheet;
    for (std::size_t j = 0; j <= steps; ++j)
      for (std::size_t i = 0; i <= steps; ++i) sheet.points.emplace_back(double(i), double(j), 0);
    for (std::size_t j = 0; j < steps; ++j)
      for (std::size_t i = 0; i < steps; ++i) {
        const std::size_t a = j * (steps + 1) + i, b = a + steps + 1;
        sheet.faces.push_back({a, a + 1, b + 1, b});
      }
    const auto mesh = meshes::surface_mesh(sheet);
    const std::vector<std::size_t> ids(steps * steps, 0);
    Analytic_surface plane;
    plane.type = Surface_type::plane;
    const Boundary_representation result = boundary_representation(
        mesh, boost::make_iterator_property_map(ids.begin(), get(boost::face_index, mesh)), {plane});
    EXPECT_EQ(result.defect(), "");
    EXPECT_EQ(result.faces.size(), 1U);
    EXPECT_EQ(result.report.edges, 4U);
    expect_relative(result.report.area, double(steps * steps), 1e-12);
  }
}

TEST(Boundary_representation, TakesACircleOfEightChordsForTheCircle) {
  Boundary_representation shape = represented(solids::box(solids::by_kernel()));
  shape.report.volume = pi;
  shape.report.mesh_volume = 2 * std::sqrt(2);
  EXPECT_EQ(shape.defect(), "");
}

TEST(Boundary_representation, SaysWhatIsWrongWithItsArguments) {
  const solids::Solid solid = solids::box(solids::by_kernel());
  EXPECT_THROW(represented(solid, std::vector<Analytic_surface>(5)), std::invalid_argument);
  for (const double scale : {0., -1., std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(represented(solid, designed_surfaces(solid), scale), std::invalid_argument);
  EXPECT_THROW(represented(solids::Solid()), std::invalid_argument);
}

TEST(Boundary_representation, CanBeCancelled) {
  const solids::Solid solid = solids::box(solids::by_kernel());
  const auto mesh = meshes::surface_mesh({solid.points, solid.faces});
  const auto ids = boost::make_iterator_property_map(solid.label.begin(), get(boost::face_index, mesh));
  std::vector<double> fractions;
  boundary_representation(mesh, ids, designed_surfaces(solid), 1, CGAL::parameters::callback([&](double fraction) {
                            fractions.push_back(fraction);
                            return true;
                          }));
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);
  EXPECT_THROW(boundary_representation(mesh, ids, designed_surfaces(solid), 1,
                                       CGAL::parameters::callback([](double) { return false; })),
               Cancelled);
}

TEST(Boundary_representation, ThatIsNotTheMeshHasADefect) {
  const Boundary_representation sound = represented(solids::box(solids::by_kernel()));
  ASSERT_EQ(sound.defect(), "");
  Boundary_representation changed = sound;
  changed.report.is_valid = false;
  changed.report.error = "its border crosses itself";
  EXPECT_EQ(changed.defect(), "its border crosses itself");
  changed = sound;
  changed.report.is_closed = false;
  EXPECT_NE(changed.defect(), "");
  changed = sound;
  changed.report.volume *= 0.8;
  EXPECT_NE(changed.defect(), "");
  changed = sound;
  changed.report.area *= 1.2;
  EXPECT_NE(changed.defect(), "");
  changed = sound;
  changed.faces[3].distance_to_mesh = 0.5;
  EXPECT_NE(changed.defect(), "");
}
