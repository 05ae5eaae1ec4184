// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_MESHES_H
#define RW_SEGMENTATION_TEST_MESHES_H

// Shapes whose answers are known, and the ways to hold them as a mesh.
//
//   template <class Holder> class Walk : public testing::Test {};
//   TYPED_TEST_SUITE(Walk, meshes::Holders);
//   TYPED_TEST(Walk, HasAProperty) {
//     const TypeParam held(meshes::cube());
//     const auto& mesh = held.mesh;  // faces and vertices in the order of the shape
//     ...

#include <gtest/gtest.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#ifdef RW_SEGMENTATION_WITH_OPENMESH
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in OpenMesh, seen when its containers are inlined
#endif
#include <CGAL/boost/graph/graph_traits_PolyMesh_ArrayKernelT.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#endif

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace meshes {

constexpr double pi = 3.14159265358979323846;

/// Points, and faces as the numbers of their corners, counterclockwise seen from outside.
struct Shape {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::size_t>> faces;
};

// ---- Shapes ----

/// The unit square in the plane z = 0, facing up: `n` by `n` squares, each of two triangles.
Shape plane(std::size_t n);

/// The surface of a union of unit cubes, given by their lowest corners; each square is divided into `n` by `n`, each
/// of two triangles. Squares come in the order of the cubes, then -x, +x, -y, +y, -z, +z.
Shape cubes(const std::vector<std::array<int, 3>>& corners, std::size_t n = 1);

/// The unit cube, 12 n^2 triangles.
Shape cube(std::size_t n = 1);

/// Two arms of a cube each, joined by a third cube: one concave edge, at x = y = 1.
Shape l_shape(std::size_t n = 1);

/// The unit cube of six squares.
Shape cube_of_quads();

/// Two rectangles of `n` by 2 `n` triangles that meet in the y-axis, where the surface turns by `angle`: a ridge for a
/// positive angle, a valley for a negative one, seen from above.
Shape folded_strip(double angle, std::size_t n = 1);

/// The surface that a curve in the half plane (radius >= 0, z) sweeps out when it turns round the z-axis in `around`
/// steps. The curve goes upward on an outer surface. A point with radius 0 becomes a pole; a `closed` curve ends where
/// it began.
Shape revolve(const std::vector<Eigen::Vector2d>& curve, std::size_t around, bool closed = false);

/// An open tube of radius 1 and height `height` along the z-axis: `around` by `along` squares, each of two triangles.
Shape tube(double height, std::size_t around, std::size_t along);

/// A prism of height 2 between two regular polygons, whose corners are at a distance of 1 from the z-axis. The sides come
/// first.
Shape prism(std::size_t sides);

/// A torus about the z-axis: `around` by `across` squares, each of two triangles.
Shape torus(double radius, double tube_radius, std::size_t around, std::size_t across);

/// Two unit spheres, their centres `distance` > 2 apart on the z-axis, joined by a neck of radius `neck` < 1. Faces
/// come from the lowest to the highest.
Shape two_spheres_with_neck(double distance, double neck, std::size_t around);

/// Each triangle cut into four by the midpoints of its edges.
Shape subdivided(const Shape& coarse);

/// A unit sphere of 20 * 4^`levels` nearly equal triangles.
Shape sphere(std::size_t levels);

// ---- Shapes from shapes ----

Shape transformed(Shape shape, const Eigen::Affine3d& map);

/// Every so many of the first faces with a pit in it, whose floor is half as long and wide. The triangles round it remain.
Shape with_pits(Shape shape, std::size_t first_faces, std::size_t step);

Shape scaled(Shape shape, double factor);

Shape moved(Shape shape, const Eigen::Vector3d& by);

/// A rotation about an axis that is parallel to nothing.
Eigen::Affine3d some_rotation();

/// Both shapes in one mesh, the faces of `first` first.
Shape together(Shape first, const Shape& second);

/// Every point displaced by a normal deviate of this standard deviation in each coordinate.
Shape with_noise(Shape shape, double deviation, unsigned seed = 1);

/// A random order of `number` things; the same one everywhere.
std::vector<std::size_t> random_order(std::size_t number, unsigned seed = 1);

/// The same shape, its i-th face being the `order[i]`-th of `shape`.
Shape with_faces_in_order(const Shape& shape, const std::vector<std::size_t>& order);

// ---- Meshes ----

using Kernel = CGAL::Simple_cartesian<double>;
using Surface_mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;  // without ids
#ifdef RW_SEGMENTATION_WITH_OPENMESH
struct Open_mesh_traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Open_mesh = OpenMesh::PolyMesh_ArrayKernelT<Open_mesh_traits>;
#endif

template <class Mesh>
void set_point(Mesh& mesh, typename boost::graph_traits<Mesh>::vertex_descriptor v, const Eigen::Vector3d& p) {
  const auto point = get(CGAL::vertex_point, mesh);
  using Point = typename boost::property_traits<std::remove_const_t<decltype(point)>>::value_type;
  put(point, v, Point(p.x(), p.y(), p.z()));
}
#ifdef RW_SEGMENTATION_WITH_OPENMESH
// CGAL's map would write single precision.
inline void set_point(Open_mesh& mesh, Open_mesh::VertexHandle v, const Eigen::Vector3d& p) {
  mesh.set_point(v, {p.x(), p.y(), p.z()});
}
#endif

/// Appends a shape to a mesh. Returns the new faces.
template <class Mesh>
std::vector<typename boost::graph_traits<Mesh>::face_descriptor> append(const Shape& shape, Mesh& mesh) {
  std::vector<typename boost::graph_traits<Mesh>::vertex_descriptor> vertices;
  for (const Eigen::Vector3d& p : shape.points) {
    vertices.push_back(add_vertex(mesh));
    set_point(mesh, vertices.back(), p);
  }
  std::vector<typename boost::graph_traits<Mesh>::face_descriptor> faces;
  for (const auto& face : shape.faces) {
    std::vector<typename boost::graph_traits<Mesh>::vertex_descriptor> corners;
    for (const std::size_t corner : face) corners.push_back(vertices[corner]);
    faces.push_back(CGAL::Euler::add_face(corners, mesh));
    if (faces.back() == boost::graph_traits<Mesh>::null_face())
      ADD_FAILURE() << "the shape is no oriented manifold at face " << faces.size() - 1;
  }
  return faces;
}

/// A shape with more faces beside it: a flap on every border edge, and a far tetrahedron.
/// Hiding or removing what follows the first `shape.faces.size()` faces gives the shape back.
Shape with_clutter(const Shape& shape);

/// A mesh by itself.
template <class Mesh_>
struct Plain {
  using Mesh = Mesh_;
  Mesh mesh;
  explicit Plain(const Shape& shape) { append(shape, mesh); }
};

/// A mesh from which faces have been removed, so that the numbers of what is left have gaps.
struct With_removed_faces {
  using Mesh = Surface_mesh;
  Mesh mesh;
  explicit With_removed_faces(const Shape& shape);
};

/// A part of a larger mesh.
struct Filtered {
  using Mesh = CGAL::Face_filtered_graph<Surface_mesh>;
  Surface_mesh whole;
  Mesh mesh;
  explicit Filtered(const Shape& shape);
  Filtered(const Filtered&) = delete;
};

#ifdef RW_SEGMENTATION_WITH_OPENMESH
using Holders = testing::Types<Plain<Surface_mesh>, Plain<Polyhedron>, With_removed_faces, Filtered, Plain<Open_mesh>>;
#else
using Holders = testing::Types<Plain<Surface_mesh>, Plain<Polyhedron>, With_removed_faces, Filtered>;
#endif

/// A shape as a `Surface_mesh`, for tests where the kind of mesh does not matter.
Surface_mesh surface_mesh(const Shape& shape);

/// One of CGAL's data meshes, such as "elephant.off"; nothing where the data are not installed:
///   const auto mesh = meshes::data_mesh("elephant.off");
///   if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
template <class Mesh = Surface_mesh>
std::optional<Mesh> data_mesh([[maybe_unused]] const std::string& name) {
#ifdef RW_SEGMENTATION_DATA_DIR
  Mesh mesh;
  if (CGAL::IO::read_polygon_mesh(RW_SEGMENTATION_DATA_DIR "/meshes/" + name, mesh)) return mesh;
  ADD_FAILURE() << "cannot read the data mesh " << name;
#endif
  return std::nullopt;
}

// What most tests instantiate is compiled once, in meshes.cpp.
extern template std::vector<Surface_mesh::Face_index> append(const Shape&, Surface_mesh&);
extern template std::vector<boost::graph_traits<Polyhedron>::face_descriptor> append(const Shape&, Polyhedron&);
#ifdef RW_SEGMENTATION_WITH_OPENMESH
extern template std::vector<boost::graph_traits<Open_mesh>::face_descriptor> append(const Shape&, Open_mesh&);
#endif
extern template std::optional<Surface_mesh> data_mesh(const std::string&);

}  // namespace meshes

#endif
