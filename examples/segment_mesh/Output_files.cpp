// SPDX-License-Identifier: MIT

#include "Output_files.h"

#include "../mesh_files/write_mesh.h"
#include "Cad_format.h"
#include "Closest_face.h"
#include "check_options.h"
#include "html_page.h"
#include "report.h"
#include "signals.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// For each face of the file the face of the mesh that speaks for it: its own, or the closest one where a repair left
/// it out.
std::vector<Mesh::Face_index> faces_in_file_order(const mesh_files::Polygon_soup& soup, const Oriented_mesh& input) {
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

namespace {

/// Merge i makes region `fragments` + i of two regions; the first regions are the fragments.
Json hierarchy_of(const std::vector<Mesh::Face_index>& faces, const Segmentation& result) {
  Json merges = Json::array();
  for (const auto& merge : result.tree.merges()) merges.push_back({merge.first, merge.second, merge.cost});
  return {{"fragments", result.tree.number_of_fragments()},
          {"components", result.tree.number_of_components()},
          {"merges", std::move(merges)},
          {"fragment_of_face", in_file_order(faces, result.fragment)}};
}

}  // namespace

Output_files::Output_files(const Files& files, const Options& options) : files_(files), options_(options) {
  if (!files.html.empty())
    page_ = std::make_unique<const Html_page>(options.page.empty() ? path_of_page() : options.page);
  for (const auto& [option, path] : written_files(files)) create(path);
  if (!files.split.empty()) split_.emplace(files.split);
}

Output_files::~Output_files() = default;

void Output_files::write(const mesh_files::Polygon_soup& soup, const Closed_parts* closed,
                         const std::vector<Mesh::Face_index>& faces, const Segmentation& result,
                         const std::vector<Segment>& segments) {
  const std::vector<std::size_t> labels = in_file_order(faces, result.label);
  const Mesh_with_labels whole = {soup, labels}, parts = closed ? Mesh_with_labels{closed->soup, closed->label} : whole;
  if (!files_.outputs.empty()) write_meshes(whole, parts, segments);
  if (!files_.labels.empty()) write_labels(labels);
  if (!files_.probabilities.empty()) write_probabilities(faces, result);
  if (!files_.hierarchy.empty()) file(files_.hierarchy).write(hierarchy_of(faces, result).dump() + "\n");
  if (split_) write_parts(parts, segments);
}

void Output_files::write_left_out(const std::vector<std::size_t>& faces) {
  if (!files_.left_out.empty()) mesh_files::write_labels(file(files_.left_out), faces);
}

void Output_files::write_page(const std::string& path, const Mesh& mesh, const Wall_map& walls,
                              const Segmentation& result, std::size_t segments) {
  if (page_) page_->write(file(files_.html), result_for_page(path, mesh, walls, result, segments, options_));
}

void Output_files::write_boundaries(const Boundary_curves& curves) {
  if (!files_.boundaries.empty()) write_curves(file(files_.boundaries), curves);
}

void Output_files::write_cad_files(const Cad_shape& shape, const std::string& name,
                                   const std::vector<Segment>& segments) {
  std::vector<mesh_files::Color> color_of_label(segments.empty() ? 0 : segments.back().label + 1);
  for (const Segment& s : segments) color_of_label[s.label] = s.color;
  for (const std::string& path : files_.outputs)
    if (const auto format = cad_format_of(path)) file(path).write(shape.content(*format, name, color_of_label));
}

void Output_files::commit(const Json& report) {
  if (!files_.report.empty()) file(files_.report).write(line_of(report));
  for (mesh_files::Output_file& file : open_) file.flush();
  const Committing guard;
  for (mesh_files::Output_file& file : open_) file.commit();
  if (split_) split_->keep();
  open_.clear();
  split_.reset();
}

mesh_files::Output_file& Output_files::file(const std::string& path) {
  return *std::find_if(open_.begin(), open_.end(), [&](const auto& file) { return file.path() == path; });
}

void Output_files::write_meshes(const Mesh_with_labels& whole, const Mesh_with_labels& parts,
                                const std::vector<Segment>& segments) {
  std::map<std::size_t, mesh_files::Color> color_of_label;
  for (const Segment& s : segments) color_of_label[s.label] = s.color;
  for (const std::string& path : files_.outputs) {
    if (cad_format_of(path)) continue;
    const Output_format format = format_of_output(path, options_);
    const auto& [soup, labels] = format == Output_format::three_mf ? parts : whole;
    write_mesh(file(path), format, {soup, labels, color_of_label});
    if (format == Output_format::obj) mesh_files::write_materials(file(material_library_of(path)), color_of_label);
  }
}

void Output_files::write_mesh(mesh_files::Output_file& file, Output_format format,
                              const mesh_files::Segmented_soup& mesh) const {
  mesh_files::write_segments(
      file, format, mesh,
      {options_.has_point_colors, std::filesystem::path(material_library_of(file.path())).filename().string()});
}

void Output_files::write_probabilities(const std::vector<Mesh::Face_index>& faces, const Segmentation& result) {
  std::vector<std::vector<double>> columns;
  for (const auto& probability : result.probabilities) columns.push_back(in_file_order(faces, probability));
  mesh_files::Output_file& out = file(files_.probabilities);
  const std::string extension = mesh_files::extension_of(files_.probabilities);
  if (extension == ".npz") return mesh_files::write_probabilities_npz(out, result.seed_labels, columns);
  if (extension == ".csv") return mesh_files::write_probabilities_csv(out, result.seed_labels, columns);
  std::vector<std::string> names;
  for (const std::size_t label : result.seed_labels) names.push_back(std::to_string(label));
  mesh_files::write_columns(out, names, columns);
}

void Output_files::write_labels(const std::vector<std::size_t>& labels) {
  mesh_files::write_labels_as(mesh_files::extension_of(files_.labels), file(files_.labels), labels);
}

void Output_files::write_parts(const Mesh_with_labels& parts, const std::vector<Segment>& segments) {
  std::map<std::size_t, std::vector<std::size_t>> faces_of = mesh_files::faces_of_labels(parts.labels);
  for (const Segment& segment : segments) {
    const std::vector<std::size_t>& faces = faces_of[segment.label];
    const mesh_files::Polygon_soup part = mesh_files::part_of(parts.soup, faces);
    const std::vector<std::size_t> part_labels(faces.size(), segment.label);
    write_mesh(create(files_.split + "/" + mesh_files::name_of_segment(segment.label) + extension_of_parts(options_)),
               options_.output_format.value_or(Output_format::ply),
               {part, part_labels, {{segment.label, segment.color}}});
  }
}

}  // namespace segment_mesh
