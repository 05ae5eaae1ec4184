#ifndef SEGMENT_MESH_OUTPUT_FILES_H
#define SEGMENT_MESH_OUTPUT_FILES_H

#include "../mesh_files.h"
#include "Boundaries.h"
#include "Closest_face.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Segmentation.h"
#include "segment_colors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

using Json = nlohmann::ordered_json;

/// For each face of the file the face of the mesh that speaks for it: its own, or the closest one where a repair left
/// it out.
inline std::vector<Mesh::Face_index> faces_in_file_order(const mesh_files::Polygon_soup& soup,
                                                         const Oriented_mesh& input) {
  std::vector<Mesh::Face_index> faces = input.mesh_face;
  std::optional<Closest_face> closest;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f] != Mesh::null_face()) continue;
    if (!closest) closest.emplace(input.mesh);
    Mesh_vector sum = CGAL::NULL_VECTOR;
    for (const auto corner : soup.face(f)) sum = sum + (soup.points[corner] - CGAL::ORIGIN);
    faces[f] = (*closest)(CGAL::ORIGIN + sum / std::max(1., static_cast<double>(soup.face(f).size())));
  }
  return faces;
}

/// The values of the mesh's faces in the order of the file.
template <class Value>
std::vector<Value> in_file_order(const std::vector<Mesh::Face_index>& faces, const std::vector<Value>& values) {
  std::vector<Value> result;
  result.reserve(faces.size());
  for (const auto f : faces) result.push_back(values[f]);
  return result;
}

/// A segment as it is listed and reported.
struct Segment {
  std::size_t label = 0;
  std::size_t faces = 0;
  double area = 0;  ///< as a part of the whole
  mesh_files::Color color{};
};

/// The area of a face in squares of `unit`.
inline double face_area(const Mesh& mesh, Mesh::Face_index f, double unit) {
  const auto first = mesh.halfedge(f);
  const Point& apex = mesh.point(mesh.source(first));
  Mesh_vector twice_the_area = CGAL::NULL_VECTOR;
  for (const auto h : mesh.halfedges_around_face(first))
    twice_the_area = twice_the_area + CGAL::cross_product((mesh.point(mesh.source(h)) - apex) / unit,
                                                          (mesh.point(mesh.target(h)) - apex) / unit);
  return CGAL::approximate_sqrt(twice_the_area.squared_length()) / 2;
}

/// Counts, areas and colours of the segments, in the order of their labels.
inline std::vector<Segment> segments_of(const Mesh& mesh, const std::vector<std::size_t>& label) {
  std::vector<std::size_t> labels = label;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::vector<Segment> segments(labels.size());
  std::vector<std::size_t> id(label.size());

  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  const double extent = std::max({box.x_span(), box.y_span(), box.z_span()});
  double total_area = 0;
  for (const auto f : mesh.faces()) {
    id[f] = static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label[f]) - labels.begin());
    const double area = extent > 0 ? face_area(mesh, f, extent) : 0;
    ++segments[id[f]].faces;
    segments[id[f]].area += area;
    total_area += area;
  }
  const auto colors = segment_colors(mesh, id, labels.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    segments[s].label = labels[s];
    segments[s].color = colors[s];
    if (total_area > 0) segments[s].area /= total_area;
  }
  return segments;
}

/// The type of a surface and the numbers that it has, in the coordinates of the mesh; angles are in degrees.
inline Json surface_of(const RW_segmentation::Analytic_surface& surface) {
  using RW_segmentation::Surface_type;
  constexpr double degree = 3.14159265358979323846 / 180;
  const auto vector = [](const auto& v) { return Json{v.x(), v.y(), v.z()}; };
  switch (surface.type) {
    case Surface_type::plane:
      return {{"type", "plane"},
              {"point", vector(surface.point)},
              {"normal", vector(surface.direction)},
              {"residual", surface.residual}};
    case Surface_type::sphere:
      return {{"type", "sphere"},
              {"centre", vector(surface.point)},
              {"radius", surface.radius},
              {"residual", surface.residual}};
    case Surface_type::cylinder:
      return {{"type", "cylinder"},
              {"point", vector(surface.point)},
              {"axis", vector(surface.direction)},
              {"radius", surface.radius},
              {"residual", surface.residual}};
    case Surface_type::cone:
      return {{"type", "cone"},
              {"apex", vector(surface.point)},
              {"axis", vector(surface.direction)},
              {"half_angle", surface.half_angle / degree},
              {"residual", surface.residual}};
    case Surface_type::torus:
      return {{"type", "torus"},          {"centre", vector(surface.point)},    {"axis", vector(surface.direction)},
              {"radius", surface.radius}, {"tube_radius", surface.tube_radius}, {"residual", surface.residual}};
    case Surface_type::free_form:
      break;
  }
  return {{"type", "free form"}};
}

template <class Policy>
Json report_of(const Options& options, const mesh_files::Polygon_soup& soup, const std::vector<std::string>& remarks,
               const Policy& policy, const Segmentation& result, const std::vector<Segment>& segments,
               const Json& milliseconds) {
  Json report = {{"mesh", options.mesh},
                 {"vertices", soup.points.size()},
                 {"faces", soup.number_of_faces()},
                 {"repairs", remarks},
                 {"degenerate_faces", result.degenerate_faces},
                 {"unseeded_components", result.unseeded_components},
                 {"island_faces", result.island_faces},
                 {"heavy_noise", result.has_heavy_noise},
                 {"seeds", result.seeds},
                 {"parameters",
                  {{"smoothing", policy.smoothing.radius},
                   {"convex_weight", policy.convex_weight},
                   {"measure", policy.measure == RW_segmentation::Dihedral_measure::angle ? "angle" : "cosine"},
                   {"sigma", policy.sigma},
                   {"cap", policy.cap}}},
                 {"segments", Json::array()},
                 {"milliseconds", milliseconds},
                 {"version", version()}};
  for (const Segment& s : segments)
    report["segments"].push_back({{"label", s.label}, {"faces", s.faces}, {"area_share", s.area}, {"color", s.color}});
  for (std::size_t s = 0; s < result.surfaces.size(); ++s)
    report["segments"][s]["surface"] = surface_of(result.surfaces[s]);
  return report;
}

/// Merge i makes region `fragments` + i of two regions; the first regions are the fragments.
inline Json hierarchy_of(const std::vector<Mesh::Face_index>& faces, const Segmentation& result) {
  Json merges = Json::array();
  for (const auto& merge : result.tree.merges()) merges.push_back({merge.first, merge.second, merge.cost});
  return {{"fragments", result.tree.number_of_fragments()},
          {"components", result.tree.number_of_components()},
          {"merges", std::move(merges)},
          {"fragment_of_face", in_file_order(faces, result.fragment)}};
}

/// The files asked for. They are created before the work, so that a wrong folder is found out at once, and appear
/// together at its end.
class Output_files {
 public:
  explicit Output_files(const Options& options) : options_(options) {
    for (const std::string& path : options.outputs) create(path);
    for (const std::string& path :
         {options.labels, options.probabilities, options.hierarchy, options.boundaries, options.report})
      if (!path.empty()) create(path);
    if (!options.split.empty()) split_.emplace(options.split);
  }

  void write(const mesh_files::Polygon_soup& soup, const std::vector<Mesh::Face_index>& faces,
             const Segmentation& result, const std::vector<Segment>& segments) {
    std::map<std::size_t, mesh_files::Color> color_of;
    for (const Segment& s : segments) color_of[s.label] = s.color;
    const std::vector<std::size_t> labels = in_file_order(faces, result.label);
    std::vector<mesh_files::Color> colors;
    colors.reserve(labels.size());
    for (const std::size_t label : labels) colors.push_back(color_of[label]);

    for (const std::string& path : options_.outputs) {
      if (mesh_files::extension_of(path) == ".ply")
        mesh_files::write_ply(file(path), soup, colors, labels);
      else
        mesh_files::write_off(file(path), soup, colors);
    }
    if (!options_.labels.empty()) mesh_files::write_labels(file(options_.labels), labels);
    if (!options_.probabilities.empty()) {
      std::vector<std::string> names;
      for (const std::size_t label : result.seed_labels) names.push_back(std::to_string(label));
      std::vector<std::vector<double>> columns;
      for (const auto& probability : result.probabilities) columns.push_back(in_file_order(faces, probability));
      mesh_files::write_columns(file(options_.probabilities), names, columns);
    }
    if (!options_.hierarchy.empty()) file(options_.hierarchy).write(hierarchy_of(faces, result).dump() + "\n");
    if (split_) write_parts(soup, labels, segments);
  }

  void write_boundaries(const Boundary_curves& curves) {
    if (!options_.boundaries.empty()) write_curves(file(options_.boundaries), curves);
  }

  /// Gives the files their names.
  void commit(const Json& report) {
    if (!options_.report.empty()) file(options_.report).write(report.dump() + "\n");
    for (mesh_files::Output_file& file : files_) file.flush();
    for (mesh_files::Output_file& file : files_) file.commit();
    if (split_) split_->keep();
  }

 private:
  mesh_files::Output_file& create(const std::string& path) { return files_.emplace_back(path); }

  mesh_files::Output_file& file(const std::string& path) {
    return *std::find_if(files_.begin(), files_.end(), [&](const auto& file) { return file.path() == path; });
  }

  void write_parts(const mesh_files::Polygon_soup& soup, const std::vector<std::size_t>& labels,
                   const std::vector<Segment>& segments) {
    std::map<std::size_t, std::vector<std::size_t>> faces_of;
    for (std::size_t f = 0; f < labels.size(); ++f) faces_of[labels[f]].push_back(f);
    for (const Segment& segment : segments) {
      const std::vector<std::size_t>& faces = faces_of[segment.label];
      mesh_files::write_ply(create(options_.split + "/segment_" + std::to_string(segment.label) + ".ply"),
                            mesh_files::part_of(soup, faces), std::vector(faces.size(), segment.color),
                            std::vector(faces.size(), segment.label));
    }
  }

  const Options& options_;
  std::optional<mesh_files::Output_folder> split_;  // outlives the files in it
  std::deque<mesh_files::Output_file> files_;
};

}  // namespace segment_mesh

#endif
