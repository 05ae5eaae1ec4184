// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BOUNDARY_REPRESENTATION_H
#define RW_SEGMENTATION_BOUNDARY_REPRESENTATION_H

// Uses Open CASCADE, which is under the LGPL 2.1 with an exception for its headers. No other header of the package does:
// without Open CASCADE leave this one out. A program links its libraries TKernel, TKMath, TKG2d, TKG3d, TKGeomBase,
// TKGeomAlgo, TKBRep and TKTopAlgo.

// Open CASCADE has a macro Handle(...). These headers of CGAL have functions of that name and come first; so must others,
// such as OpenMesh's.
#include <CGAL/Handle.h>
#include <CGAL/Lazy.h>

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Shape_attempt.h>
#include <RW_segmentation/internal/brep/Shape_building.h>
#include <RW_segmentation/internal/brep/Shape_distances.h>
#include <RW_segmentation/internal/brep/Shell_nesting.h>
#include <RW_segmentation/internal/brep/kernel_errors.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/surfaces/out_of_box.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <Standard_Failure.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// A face of a boundary representation, beside the triangles that it stands for.
struct Boundary_face {
  TopoDS_Face face;         ///< part of the shape
  std::size_t segment = 0;  ///< its own, or, for slivers of a few triangles, that of a neighbour
  /// A free form is a fitted B-spline surface.
  Surface_type type = Surface_type::free_form;
  bool is_triangle = false;     ///< a single triangle, where nothing else was valid
  bool has_chords = false;      ///< within the edges of the mesh instead of smooth ones
  double area = 0;              ///< of the face
  double mesh_area = 0;         ///< of its triangles
  double distance_of_mesh = 0;  ///< of the corners of its triangles from the closest surface round them, at most
  double distance_to_mesh = 0;  ///< of points of the face from the mesh, at most; 0 for triangles
  double tolerance = 0;         ///< within which its edges lie on its surface
};

/// What became of a mesh. Lengths, areas and volumes are in the units of the shape.
struct Boundary_report {
  bool is_valid = false;        ///< by the kernel's own check
  bool is_closed = false;       ///< whether every component that the mesh closes is closed
  std::string error;            ///< the first thing that is not valid; empty if nothing is
  std::size_t solids = 0;       ///< one for each closed component that is no void
  std::size_t voids = 0;        ///< in solids
  std::size_t open_shells = 0;  ///< of components with a border
  std::size_t edges = 0;        ///< between two faces, or at the border
  double area = 0;              ///< of all faces
  double mesh_area = 0;         ///< of all triangles
  double volume = 0;            ///< of the solids
  double mesh_volume = 0;       ///< of the closed components, which has chords where solids have arcs
  double diagonal = 0;          ///< of the mesh's bounding box
  /// How many patches were refused, by the reason; each was made again in another way.
  std::map<std::string, std::size_t> refusals;
};

/// A mesh as faces on surfaces, with edges and vertices that they share.
struct Boundary_representation {
  TopoDS_Shape shape;                ///< a solid, an open shell, or a compound of several of them
  std::vector<Boundary_face> faces;  ///< of the shape
  Boundary_report report;            ///< of the whole

  /// How many faces are of a type, single triangles not counted.
  std::size_t number_of_faces(Surface_type type) const {
    return static_cast<std::size_t>(std::count_if(
        faces.begin(), faces.end(), [&](const Boundary_face& f) { return f.type == type && !f.is_triangle; }));
  }
  /// How many faces are single triangles.
  std::size_t number_of_triangles() const {
    return static_cast<std::size_t>(
        std::count_if(faces.begin(), faces.end(), [](const Boundary_face& f) { return f.is_triangle; }));
  }

  /// Why the shape does not stand for the mesh; empty if it does.
  ///
  /// That the kernel calls it valid is not enough: a valid shape may have a face on the wrong side of its surface. So it must
  /// be closed as well, its area and volume must be those of the mesh but for what chords cut off, and neither may be far
  /// from the other.
  std::string defect() const;
};

inline std::string Boundary_representation::defect() const {
  constexpr double largest_share = 0.1;      // of area or volume; chords of a circle in 8 parts cut off as much
  constexpr double largest_distance = 0.03;  // of the diagonal; likewise
  const auto differs = [](double a, double b) {
    return !(std::abs(a - b) <= largest_share * std::max(std::abs(a), std::abs(b)));
  };
  if (!report.is_closed) return "it is not closed";
  if (!report.is_valid) return report.error;
  if (differs(report.area, report.mesh_area)) return "its area is not that of the mesh";
  if (report.solids > 0 && differs(report.volume, report.mesh_volume)) return "its volume is not that of the mesh";
  for (const Boundary_face& face : faces)
    if (std::max(face.distance_of_mesh, face.distance_to_mesh) > largest_distance * report.diagonal)
      return "a face is far from the mesh";
  return "";
}

namespace internal {

/// \param distances_of_vertices of the component's mesh from the shape
inline Boundary_face boundary_face(const brep::Shape_component& component,
                                   const std::vector<double>& distances_of_vertices, brep::Distance_to_mesh& distance,
                                   std::size_t patch_number) {
  const auto& [mesh, building] = component;
  const brep::Patch& patch = building.patches()[patch_number];
  Boundary_face result;
  result.face = building.faces()[patch_number];
  result.segment = patch.segment;
  result.is_triangle = patch.has_triangles();
  result.has_chords = patch.has_chords();
  if (result.is_triangle)
    result.type = Surface_type::plane;
  else if (const auto* placed = dynamic_cast<const brep::Placed_surface*>(patch.surface.get()))
    result.type = placed->type();
  result.area = building.integrals()[patch_number].area;
  result.mesh_area = brep::area_of(mesh, patch.triangles);
  for (const std::size_t t : patch.triangles)
    for (const std::size_t v : mesh.corners(t))
      result.distance_of_mesh = std::max(result.distance_of_mesh, distances_of_vertices[v]);
  result.distance_to_mesh = result.is_triangle ? 0 : distance.of_face(result.face);
  result.tolerance = building.tolerances()[patch_number];
  return result;
}

/// The faces of each connected component, across walls.
inline std::vector<std::vector<Dual_mesh::Index>> connected_faces(const Dual_mesh& mesh) {
  const Components components(mesh.graph(), [](Dual_mesh::Index) { return true; });
  std::vector<std::vector<Dual_mesh::Index>> faces(components.count);
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) faces[components.of[f]].push_back(f);
  return faces;
}

/// \param segment_of_face numbers of surfaces
inline Boundary_representation boundary_representation(const Dual_mesh& mesh,
                                                       const std::vector<std::size_t>& segment_of_face,
                                                       std::vector<Analytic_surface> surfaces, double scale,
                                                       const Progress& progress) try {
  for (Analytic_surface& surface : surfaces) surface = out_of_box(surface, scale, Eigen::Vector3d::Zero());
  // Each component by itself: its lengths decide how exact it is to be, and only it is made again where a face is refused.
  std::deque<brep::Shape_component> components;
  std::size_t faces_done = 0;
  for (const std::vector<Dual_mesh::Index>& faces : connected_faces(mesh)) {
    constexpr double building = 0.8;  // of all
    const auto share = [&](std::size_t done) { return building * double(done) / double(mesh.number_of_faces()); };
    components.emplace_back(mesh, scale, faces, segment_of_face, surfaces,
                            progress.part(share(faces_done), share(faces_done + faces.size())));
    faces_done += faces.size();
  }
  const brep::Shell_nesting nesting(components);

  Boundary_representation result;
  result.shape = nesting.shape();
  Boundary_report& report = result.report;
  brep::Distance_to_mesh distance(mesh, scale);
  std::size_t missing_faces = 0;
  for (const brep::Shape_component& component : components) {
    const std::vector<double> distances =
        brep::distances_of_vertices(component.mesh, component.building.patches(), component.building.faces());
    for (std::size_t i = 0; i < component.building.patches().size(); ++i) {
      if (component.building.faces()[i].IsNull()) {
        ++missing_faces;
        continue;
      }
      result.faces.push_back(boundary_face(component, distances, distance, i));
      report.area += result.faces.back().area;
      report.mesh_area += result.faces.back().mesh_area;
    }
    report.edges += component.building.number_of_edges();
    for (const auto& [reason, number] : component.building.refusals()) report.refusals[reason] += number;
  }
  progress(0.9);
  // All faces but triangles were checked by themselves, with all of their geometry, as they were made.
  report.error = brep::first_error(result.shape, brep::Checked::topology);
  for (const Boundary_face& face : result.faces)
    if (report.error.empty() && face.is_triangle) report.error = brep::first_error(face.face);
  report.is_valid = report.error.empty();
  report.is_closed = missing_faces == 0;
  report.solids = nesting.solids();
  report.voids = nesting.voids();
  report.open_shells = nesting.open_shells();
  report.diagonal = scale * mesh.unit();
  report.volume = nesting.volume();
  report.mesh_volume = nesting.mesh_volume();
  progress(1);
  return result;
} catch (const Standard_Failure& error) {
  throw std::runtime_error(std::string("Open CASCADE: ") + error.GetMessageString());
}

}  // namespace internal

/// Makes the boundary representation of a mesh, which CAD systems read, from its segments and their surfaces.
///
/// \code
/// const std::size_t segments = segmentation_into_surfaces(mesh, ids);
/// const auto solid = boundary_representation(mesh, ids, segment_surfaces(mesh, ids, segments));
/// if (solid.defect().empty()) STEPControl_Writer writer; ...
/// \endcode
///
/// The mesh's topology becomes that of the shape: faces for the connected pieces of segments, edges for the chains between
/// two of them, vertices where chains meet. So the shape is as closed as the mesh. Vertices and edges are moved onto the
/// surfaces around them; edges are lines, circles, and splines. What closes round an axis is cut in halves, which leaves
/// neither seams nor poles. A free form becomes one or more B-spline surfaces, fitted to its vertices. A face that the kernel
/// does not call valid is made again: within the edges of the mesh, as a B-spline surface, and at last as triangles.
///
/// Each closed component becomes a solid; one that looks inward and lies in another becomes a void in that; components
/// with a border become shells. Faces of more than three sides are cut into triangles.
///
/// Complexity: the times of Open CASCADE for each face and edge, of which those of a component are put together again as long
/// as one is refused; and a pass over the triangles of a component for each cut of a patch.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to integers
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param segment_ids the number of the surface of each face
/// \param surfaces what `segment_surfaces()` returned
/// \param scale of the shape beside the mesh: 25.4 where the mesh is in inches and the shape in millimetres, which Open
/// CASCADE takes its shapes to be in. Its tolerances are absolute, 1e-7 at the least: a shape should not be smaller than 0.01.
/// \param np
/// - `vertex_point_map` (default: that of the mesh)
/// - `callback` (`std::function<bool(double)>`, default: none): receives the fraction done, returns `false` to cancel
/// \returns the shape, its faces and a report; look at `defect()` before you use it
/// \throws std::invalid_argument if the mesh has no face, a coordinate is not finite, a segment has no surface, `scale` is
/// not a positive number, or the mesh has two edges between the same vertices
/// \throws std::runtime_error if Open CASCADE fails
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Boundary_representation boundary_representation(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                                                const std::vector<Analytic_surface>& surfaces, double scale = 1,
                                                const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::is_readable_map<SegmentIdMap, typename boost::graph_traits<FaceListGraph>::face_descriptor>,
                "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");
  static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Callback>,
                "boundary_representation() takes the named parameters vertex_point_map and callback.");
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    if (dual.number_of_faces() == 0) throw std::invalid_argument("the mesh has no faces");
    if (!(scale > 0 && scale <= std::numeric_limits<double>::max()))
      throw internal::argument_error("scale", scale, "larger than 0 and finite");
    const std::vector<std::size_t> segment_of_face = dual.read_segments(segment_ids);
    for (const std::size_t segment : segment_of_face)
      if (segment >= surfaces.size())
        throw internal::argument_error("a segment id", segment, "less than the number of surfaces");
    return internal::boundary_representation(dual, segment_of_face, surfaces, scale, internal::progress_of(np));
  });
}

}  // namespace RW_segmentation

#endif
