// SPDX-License-Identifier: MIT

// Uses box_intersection_d and Polygon_mesh_processing of CGAL, which is under the GPL.

#include "Oriented_mesh.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/box_intersection_d.h>

#include <boost/property_map/property_map.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace segment_mesh {

namespace {

bool has_distinct_corners(std::vector<Mesh::Vertex_index> corners) {
  std::sort(corners.begin(), corners.end());
  return corners.size() > 2 && std::adjacent_find(corners.begin(), corners.end()) == corners.end();
}

/// The mesh whose face i has the corners `corners_of(i)`; none if the faces as they are do not form an oriented surface.
template <class Corners_of_face>
std::optional<Mesh> mesh_of_faces(const std::vector<Point>& points, std::size_t number_of_faces,
                                  const Corners_of_face& corners_of) {
  Mesh mesh;
  mesh.reserve(static_cast<Mesh::size_type>(points.size()),
               static_cast<Mesh::size_type>(points.size() + number_of_faces),
               static_cast<Mesh::size_type>(number_of_faces));
  for (const Point& p : points) mesh.add_vertex(p);
  std::vector<Mesh::Vertex_index> corners;
  for (std::size_t f = 0; f < number_of_faces; ++f) {
    corners.clear();
    for (const auto corner : corners_of(f)) corners.emplace_back(static_cast<Mesh::size_type>(corner));
    if (!has_distinct_corners(corners) || mesh.add_face(corners) == Mesh::null_face()) return std::nullopt;
  }
  return mesh;
}

/// Whether two border edges of a mesh lie between the same two points.
bool has_coinciding_border_edges(const Mesh& mesh) {
  std::vector<std::pair<Point, Point>> border;
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h)) border.push_back(std::minmax({mesh.point(mesh.source(h)), mesh.point(mesh.target(h))}));
  std::sort(border.begin(), border.end());
  return std::adjacent_find(border.begin(), border.end()) != border.end();
}

/// A face on its way through CGAL's repairs, which move, drop and split faces.
struct Numbered_face : std::vector<std::size_t> {
  using std::vector<std::size_t>::vector;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t number = none;  ///< in the file; none for a part that was split off
};

/// The parts of a face that touches itself in a corner, each with corners of its own, in the order in which they end. Parts
/// without three corners are none.
std::vector<Numbered_face> parts_of(const Numbered_face& face) {
  std::vector<Numbered_face> parts;
  Numbered_face path;
  path.number = face.number;
  std::unordered_map<std::size_t, std::size_t> place;  // of the corners of the path
  const auto cut = [&](std::size_t begin) {
    Numbered_face part = path;
    part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(begin));
    if (part.size() > 2) parts.push_back(std::move(part));
  };
  for (const std::size_t corner : face) {
    const auto [found, is_new] = place.emplace(corner, path.size());
    if (is_new) {
      path.push_back(corner);
      continue;
    }
    const std::size_t begin = found->second;
    cut(begin);
    for (std::size_t i = begin + 1; i < path.size(); ++i) place.erase(path[i]);
    path.resize(begin + 1);
  }
  cut(0);
  return parts;
}

/// Takes faces apart that touch themselves, at the end of all faces.
/// \returns how many
std::size_t split_faces_that_touch_themselves(std::vector<Numbered_face>& faces) {
  std::size_t split = 0;
  const std::size_t number_of_faces = faces.size();
  for (std::size_t f = 0; f < number_of_faces; ++f) {
    std::vector<Numbered_face> parts = parts_of(faces[f]);
    if (parts.size() < 2) continue;
    ++split;
    faces[f] = std::move(parts[0]);
    std::move(parts.begin() + 1, parts.end(), std::back_inserter(faces));
  }
  return split;
}

/// Notes what `CGAL::Polygon_mesh_processing::orient_polygon_soup()` meets.
struct Orientation_notes : CGAL::Polygon_mesh_processing::Default_orientation_visitor {
  struct Notes {
    std::set<std::pair<std::size_t, std::size_t>> non_manifold_edges;  // each is met once for each of its faces
    std::size_t non_manifold_vertices = 0, reversed_faces = 0;
  };
  std::shared_ptr<Notes> notes = std::make_shared<Notes>();  // CGAL takes a copy of the visitor

  void non_manifold_edge(std::size_t v, std::size_t w, std::size_t) {
    notes->non_manifold_edges.insert(std::minmax(v, w));
  }
  void non_manifold_vertex(std::size_t, std::size_t) { ++notes->non_manifold_vertices; }
  void polygon_orientation_reversed(std::size_t) { ++notes->reversed_faces; }
};

/// Makes a surface of faces that do not form one as they are: merges points with equal coordinates, leaves out faces
/// without three different corners and copies of other faces, orients neighbours alike and splits the surface where
/// more than two faces meet at an edge.
Oriented_mesh mesh_of_soup(const mesh_files::Polygon_soup& soup) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  Oriented_mesh result;
  std::vector<std::string>& remarks = result.remarks;
  std::vector<Point> points = soup.points;
  std::vector<Numbered_face> faces(soup.number_of_faces());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    faces[f].assign(soup.face(f).begin(), soup.face(f).end());
    faces[f].number = f;
  }

  const std::size_t merged = PMP::merge_duplicate_points_in_polygon_soup(points, faces);
  if (merged > 0)
    remarks.push_back("merged " + counted(merged, "vertex", "vertices") + " into others with equal coordinates");
  const std::size_t split = split_faces_that_touch_themselves(faces);
  if (split > 0)
    remarks.push_back("split " + counted(split, "face that touches itself", "faces that touch themselves"));
  PMP::repair_polygon_soup(points, faces);
  std::stable_sort(faces.begin(), faces.end(),
                   [](const Numbered_face& a, const Numbered_face& b) { return a.number < b.number; });

  const Orientation_notes visitor;
  PMP::orient_polygon_soup(points, faces, CGAL::parameters::visitor(visitor));
  const auto& [edges, vertices, reversed] = *visitor.notes;
  if (!edges.empty())
    remarks.push_back("split the surface along " + counted(edges.size(), "edge") + " where more than two faces meet");
  if (vertices > 0)
    remarks.push_back("split the surface at " + counted(vertices, "vertex", "vertices") + " where parts touch");
  if (reversed > 0) remarks.push_back("turned " + counted(reversed, "face") + " to match the neighbours");

  auto mesh = mesh_of_faces(points, faces.size(), [&](std::size_t f) -> const Numbered_face& { return faces[f]; });
  if (!mesh) throw std::runtime_error("the faces of the file could not be made into a surface");
  result.mesh = std::move(*mesh);
  result.mesh_face.assign(soup.number_of_faces(), Mesh::null_face());
  for (std::size_t f = faces.size(); f-- > 0;)  // the first part speaks for a face that was split
    if (faces[f].number != Numbered_face::none)
      result.mesh_face[faces[f].number] = Mesh::Face_index(static_cast<Mesh::size_type>(f));
  const auto left_out =
      static_cast<std::size_t>(std::count(result.mesh_face.begin(), result.mesh_face.end(), Mesh::null_face()));
  if (left_out > 0)
    remarks.push_back(counted(left_out, "face") +
                      " of the file left out of the mesh: without three different corners, or equal to another face");
  return result;
}

/// A part of a mesh that hangs together by edges.
struct Component {
  std::vector<Mesh::Face_index> faces;
  CGAL::Bbox_3 box;
  bool is_closed = true;
  double volume = 0;  ///< signed, in cubes of the mesh's largest extent; of closed components only
};

std::vector<Component> components(const Mesh& mesh) {
  std::vector<std::size_t> component_of(mesh.num_faces());
  const auto component_map = boost::make_iterator_property_map(component_of.begin(), get(boost::face_index, mesh));
  std::vector<Component> result(CGAL::Polygon_mesh_processing::connected_components(mesh, component_map));
  if (result.empty()) return result;

  const double extent = extent_of(mesh);
  for (const auto f : mesh.faces()) {
    Component& component = result[get(component_map, f)];
    component.faces.push_back(f);
    const Point& origin = mesh.point(mesh.target(mesh.halfedge(component.faces.front())));
    const auto scaled = [&](Mesh::Vertex_index v) { return (mesh.point(v) - origin) / extent; };
    const auto apex = scaled(mesh.target(mesh.halfedge(f)));
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      component.is_closed = component.is_closed && !mesh.is_border(mesh.opposite(h));
      component.box += mesh.point(mesh.target(h)).bbox();
      component.volume += CGAL::determinant(apex, scaled(mesh.source(h)), scaled(mesh.target(h))) / 6;
    }
  }
  return result;
}

/// Turns closed components whose faces look inward, unless they may be cavities: a component whose bounding box lies
/// inside that of another closed one is left as it is.
/// \returns the number of components turned
std::size_t turn_components_outward(Mesh& mesh) {
  constexpr double rounding = 1e-14;
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  const std::vector<Component> all = components(mesh);
  std::vector<Box> closed, inward;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].is_closed) continue;
    closed.emplace_back(all[i].box, i);
    if (all[i].volume < -rounding) inward.emplace_back(all[i].box, i);
  }

  std::vector<bool> may_be_cavity(all.size(), false);
  CGAL::box_intersection_d(
      inward.begin(), inward.end(), closed.begin(), closed.end(), [&](const Box& inner, const Box& outer) {
        bool is_inside = true;
        for (int i = 0; i < 3; ++i)
          is_inside = is_inside && outer.min_coord(i) < inner.min_coord(i) && inner.max_coord(i) < outer.max_coord(i);
        if (is_inside) may_be_cavity[inner.info()] = true;
      });
  std::size_t turned = 0;
  for (const Box& box : inward) {
    if (may_be_cavity[box.info()]) continue;
    CGAL::Polygon_mesh_processing::reverse_face_orientations(all[box.info()].faces, mesh);
    ++turned;
  }
  return turned;
}

}  // namespace

Oriented_mesh oriented_mesh(const mesh_files::Polygon_soup& soup, const Repairs& repairs) {
  Oriented_mesh result;
  auto mesh = mesh_of_faces(soup.points, soup.number_of_faces(), [&](std::size_t f) { return soup.face(f); });
  if (mesh && !(repairs.stitch && has_coinciding_border_edges(*mesh))) {
    result.mesh = std::move(*mesh);
    result.mesh_face.assign(result.mesh.faces_begin(), result.mesh.faces_end());
  } else {
    result = mesh_of_soup(soup);
  }
  if (repairs.orient) {
    const std::size_t turned = turn_components_outward(result.mesh);
    if (turned > 0) result.remarks.push_back("turned " + counted(turned, "closed part") + " whose faces looked inward");
  }
  return result;
}

}  // namespace segment_mesh
