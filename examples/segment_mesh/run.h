// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_RUN_H
#define SEGMENT_MESH_RUN_H

#include "../mesh_files/Polygon_soup.h"
#include "Cad_format.h"
#include "Cad_library.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Output_files.h"
#include "Segmentation.h"
#include "Stages.h"
#include "Task.h"
#include "check_options.h"
#include "close_parts.h"
#include "failure.h"
#include "read_input.h"
#include "report.h"
#include "seeds.h"
#include "segments.h"
#include "signals.h"
#include "treat_boundaries.h"
#include "walls.h"

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// What is odd but not wrong.
inline std::vector<std::string> remarks_on(const Segmentation& result, bool has_seeds) {
  std::vector<std::string> remarks;
  if (result.degenerate_faces > 0)
    remarks.push_back(counted(result.degenerate_faces, "face") + " without area, joined to the neighbours");
  if (result.has_heavy_noise) remarks.push_back("much noise: the shape was taken from a smoothed copy of the mesh");
  if (result.unseeded_components > 0)
    remarks.push_back(counted(result.unseeded_components, "component") + " without a seed, each a segment of its own");
  if (result.island_faces > 0)
    remarks.push_back(counted(result.island_faces, "face") + " cut off from the " +
                      (has_seeds ? "seed of their part" : "rest of their fragment") + ", given to the neighbours");
  return remarks;
}

/// What binary STL files lose of a mesh that is far away, as maps are.
inline std::vector<std::string> remarks_on_precision(const Options& options, const Mesh& mesh) {
  constexpr double far = 4096;  // extents, of which rounding is a quarter of a thousandth then
  const auto& outputs = options.files.outputs;
  const bool has_floats = (!options.files.split.empty() && options.output_format == Output_format::stl) ||
                          std::any_of(outputs.begin(), outputs.end(), [&](const std::string& path) {
                            return !cad_format_of(path) && format_of_output(path, options) == Output_format::stl;
                          });
  if (!has_floats) return {};
  double distance = 0;
  for (const Point& p : mesh.points())
    distance = std::max({distance, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
  if (!(distance > far * extent_of(mesh))) return {};
  return {
      "the mesh is so far from the origin that its shape suffers in .stl, which is single precision: .ply and "
      "--output-format stl-text keep it"};
}

/// Makes and writes the CAD files, if any are asked for.
/// \returns what the report says of them; null without any
/// \throws Unsound_shape if they would not be right, and the user does not want them then
inline Json write_cad_files(const Task& task, const Options& options, const Mesh& mesh, const Segmentation& result,
                            const std::vector<Segment>& segments, Stages& stages, Output_files& files) {
  if constexpr (writes_cad_files) {
    if (!options.has_cad_files()) return {};
    const auto callback = stages.start("surfaces and edges");
    const Dual dual(mesh);
    std::vector<std::size_t> labels = result.label;
    const std::vector<std::size_t> label_of_number = dual.read_segments(face_map(mesh, labels));
    const Length_unit unit = options.unit.value_or(length_units[0]);
    const std::unique_ptr<const Cad_shape> shape(cad_library()(dual, label_of_number, result.surfaces, unit, callback));
    if (!shape->defect().empty() && !options.keeps_invalid) throw Unsound_shape(shape->defect());
    files.write_cad_files(*shape, name_of_mesh(task.mesh), segments);
    return shape->report();
  }
  return {};
}

/// What is odd about CAD files.
inline std::vector<std::string> remarks_on_cad_files(const Json& report, bool is_unit_given) {
  std::vector<std::string> remarks;
  if (report.is_null()) return remarks;
  if (!is_unit_given) remarks.push_back("the CAD file takes the coordinates for millimetres; --unit tells others");
  if (const auto triangles = report["triangles"].get<std::size_t>(); triangles > 0)
    remarks.push_back(counted(triangles, "triangle") + " of the mesh, which no surface fits, stayed in the CAD file");
  if (const auto defect = report["defect"].get<std::string>(); !defect.empty())
    remarks.push_back("the CAD file is not right: " + defect);
  return remarks;
}

/// Whether a CAD file was written that is not right.
inline bool has_unsound_shape(const Json& report) {
  return report.contains("cad") && !report["cad"]["defect"].get<std::string>().empty();
}

/// The walls that the user asks for.
/// \throws std::invalid_argument if there is no such edge
inline Wall_map walls_of(const Options& options, const std::vector<Constraint>& constraints,
                         const mesh_files::Polygon_soup& soup, Mesh& mesh) {
  const Wall_map walls = wall_map(mesh);
  mark_constraints(soup.points, constraints, mesh, walls);
  if (options.constraints_angle) mark_sharp_edges(mesh, *options.constraints_angle, walls);
  return walls;
}

/// Segments a mesh as the options tell and writes its files.
/// \param title of the progress bar
/// \returns the report
inline Json run(const Task& task, const Options& options, const std::string& title) {
  Stages stages(!options.is_quiet, title, is_interrupted, Deadline(options.seconds));
  const std::vector<Seed_argument> seed_texts = seed_arguments(options, task.files.seeds);
  std::vector<Constraint> constraints;
  if (!task.files.constraints.empty()) constraints = read_constraints(task.files.constraints);
  const Method method = method_of(options);
  const auto remark = [&](const std::vector<std::string>& remarks) {
    if (options.is_quiet) return;
    for (const std::string& text : remarks) say(task.mesh + ": " + text);
  };

  stages.start("reading");
  mesh_files::Polygon_soup soup = read_input(task.mesh, options.format);
  stages.start("repair");
  refuse_mesh_without_faces(task.mesh, soup);
  Oriented_mesh input = oriented_mesh(soup, options.repairs);
  stages.end();
  refuse_mesh_without_faces(task.mesh, input);
  input.remarks.insert(input.remarks.begin(), soup.remarks.begin(), soup.remarks.end());
  remark(input.remarks);

  const std::vector<Face_label> seeds = seed_faces(seed_texts, input);
  const Wall_map walls = walls_of(options, constraints, soup, input.mesh);
  const std::vector<std::size_t> left_out = faces_left_out(input);
  // Before the first output is created, or a signal in between would leave it behind.
  survive_signals();
  Output_files files(task.files, options);
  Segmentation result = segment(input.mesh, walls, seeds, options, method, stages);
  if (const std::size_t polygons = treat_boundaries(options, soup, input, walls, result, stages, files); polygons > 0) {
    input.remarks.push_back(counted(polygons, "polygon") + " cut into triangles, into which boundaries can be cut");
    remark({input.remarks.back()});
  }

  std::optional<Closed_parts> closed;
  if (options.are_parts_closed) {
    stages.start("caps");
    closed = closed_parts(input.mesh, result.label);
  }
  const std::vector<Segment> all_segments = segments_of(input.mesh, result.label);
  const Json cad_report = write_cad_files(task, options, input.mesh, result, all_segments, stages, files);
  stages.start("writing");
  const auto faces = faces_in_file_order(soup, input);
  const std::vector<Segment> segments = counted_in_file(all_segments, in_file_order(faces, result.label));
  // Closed parts are those of the mesh: some may have no face of the file, see `counted_in_file()`.
  files.write(soup, closed ? &*closed : nullptr, faces, result, closed ? all_segments : segments);
  files.write_left_out(left_out);
  files.write_page(task.mesh, input.mesh, walls, result, all_segments.size());
  stages.end();
  Json report = report_of(task.mesh, soup, input.remarks, left_out.size(), parameters_of(options, method), result,
                          segments, stages.milliseconds());
  if (closed) add_closed_parts(report, *closed);
  if (!cad_report.is_null()) report["cad"] = cad_report;
  files.commit(report);
  if (closed) remark(closed->remarks);
  remark(remarks_on_precision(options, input.mesh));
  remark(remarks_on_cad_files(cad_report, options.unit.has_value()));
  remark(remarks_on(result, options.has_seeds() || options.is_coarse));
  return report;
}

}  // namespace segment_mesh

#endif
