// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_RUN_H
#define SEGMENT_MESH_RUN_H

#include "../mesh_files.h"
#include "Boundaries.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Output_files.h"
#include "Segmentation.h"
#include "Stages.h"
#include "Task.h"
#include "limits.h"
#include "report.h"
#include "seeds.h"
#include "segments.h"
#include "walls.h"

#include <RW_segmentation/Progress.h>

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace segment_mesh {

inline volatile std::sig_atomic_t is_interrupted = 0;

inline void interrupt(int signal) {
  is_interrupted = 1;
  std::signal(signal, SIG_DFL);  // the second time ends the program at once
}

/// Messages on standard error.
inline void say(const std::string& message) { std::fprintf(stderr, "segment_mesh: %s\n", message.c_str()); }

/// How the work on a mesh ended.
struct Outcome {
  Exit_code code = success;
  std::string message;
};

/// The outcome that the exception in flight stands for.
inline Outcome failure(const std::string& mesh, const Options& options) {
  try {
    throw;
  } catch (const CLI::ParseError& error) {
    return {wrong_usage, error.what()};
  } catch (const mesh_files::Unreadable_file& error) {
    return {unreadable_input, error.what()};
  } catch (const std::invalid_argument& error) {
    return {wrong_argument, mesh + ": " + error.what()};
  } catch (const mesh_files::Unwritable_file& error) {
    return {unwritable_output, error.what()};
  } catch (const RW_segmentation::Cancelled&) {
    return {cancelled, "cancelled, nothing was written"};
  } catch (const Out_of_time&) {
    return {reached_limit, mesh + ": the time limit is over, nothing was written"};
  } catch (const std::bad_alloc&) {
    if (options.bytes) return {reached_limit, mesh + ": out of the memory that --max-memory allows"};
    return {failed_computation, mesh + ": out of memory"};
  } catch (const std::exception& error) {
    // TBB's words where the stack of a thread does not fit any more.
    if (options.bytes && std::string(error.what()).find("pthread_create") != std::string::npos)
      return {reached_limit, mesh + ": out of the memory that --max-memory allows"};
    return {failed_computation, mesh + ": " + error.what()};
  }
}

/// What is odd but not wrong.
inline std::vector<std::string> remarks_on(const Segmentation& result) {
  std::vector<std::string> remarks;
  if (result.degenerate_faces > 0)
    remarks.push_back(counted(result.degenerate_faces, "face") + " without area, joined to the neighbours");
  if (result.has_heavy_noise) remarks.push_back("much noise: the shape was taken from a smoothed copy of the mesh");
  if (result.unseeded_components > 0)
    remarks.push_back(counted(result.unseeded_components, "component") + " without a seed, each a segment of its own");
  if (result.island_faces > 0)
    remarks.push_back(counted(result.island_faces, "face") +
                      " cut off from the seed of their part, given to the neighbours");
  return remarks;
}

/// Smooths and writes the boundaries and cuts them into the mesh, as far as asked for.
inline void treat_boundaries(const Options& options, mesh_files::Polygon_soup& soup, Oriented_mesh& input,
                             const Wall_map& walls, Segmentation& result, Stages& stages, Output_files& files) {
  if (!options.is_refined && options.files.boundaries.empty()) return;
  const auto callback = stages.start("boundaries");
  const Boundary_curves curves =
      boundary_curves(input.mesh, walls, result.label, options.is_smooth || options.is_refined, callback);
  files.write_boundaries(curves);
  if (!options.is_refined) return;
  cut_boundaries(input.mesh, curves, result);
  soup = soup_of(input.mesh);
  input.mesh_face.assign(input.mesh.faces_begin(), input.mesh.faces_end());
}

/// The walls that the user asks for.
/// \throws std::invalid_argument if there is no such edge
inline Wall_map walls_of(const Options& options, const std::vector<Constraint>& constraints,
                         const mesh_files::Polygon_soup& soup, Mesh& mesh) {
  const Wall_map walls = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_wall", false).first;
  mark_constraints(soup, constraints, mesh, walls);
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
  mesh_files::Polygon_soup soup = mesh_files::read_mesh(task.mesh);
  stages.start("repair");
  Oriented_mesh input = oriented_mesh(soup, options.repairs);
  stages.end();
  if (input.mesh.number_of_faces() == 0 && soup.number_of_faces() > 0)
    throw mesh_files::Unreadable_file(task.mesh + ": no face has three different corners");
  remark(input.remarks);

  const std::vector<Face_label> seeds = seed_faces(seed_texts, input);
  const Wall_map walls = walls_of(options, constraints, soup, input.mesh);
  // Before the first output is created, or a signal in between would leave it behind.
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  Output_files files(task.files, options);
  Segmentation result = segment(input.mesh, walls, seeds, options, method, stages);
  treat_boundaries(options, soup, input, walls, result, stages, files);

  stages.start("writing");
  const std::vector<Segment> segments = segments_of(input.mesh, result.label);
  files.write(soup, faces_in_file_order(soup, input), result, segments);
  files.write_page(task.mesh, input.mesh, result, segments.size());
  stages.end();
  Json report = report_of(task.mesh, soup, input.remarks, parameters_of(options, method), result, segments,
                          stages.milliseconds());
  files.commit(report);
  remark(remarks_on(result));
  return report;
}

}  // namespace segment_mesh

#endif
