// The command-line tool: a mesh file in, a coloured mesh, labels and probabilities out.

#include "mesh_files.h"
#include "segment_mesh/Boundaries.h"
#include "segment_mesh/Options.h"
#include "segment_mesh/Oriented_mesh.h"
#include "segment_mesh/Output_files.h"
#include "segment_mesh/Segmentation.h"
#include "segment_mesh/Stages.h"
#include "segment_mesh/seeds.h"

#include <RW_segmentation/Engineering_segmentation.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace segment_mesh {
namespace {

volatile std::sig_atomic_t is_interrupted = 0;

void interrupt(int signal) {
  is_interrupted = 1;
  std::signal(signal, SIG_DFL);  // the second time ends the program at once
}

/// Messages on standard error.
void say(const std::string& message) { std::fprintf(stderr, "segment_mesh: %s\n", message.c_str()); }

void say_what_is_odd(const Segmentation& result) {
  if (result.degenerate_faces > 0)
    say(counted(result.degenerate_faces, "face") + " without area, joined to the neighbours");
  if (result.has_heavy_noise) say("much noise: the shape was taken from a smoothed copy of the mesh");
  if (result.unseeded_components > 0)
    say(counted(result.unseeded_components, "component") + " without a seed, each a segment of its own");
  if (result.island_faces > 0)
    say(counted(result.island_faces, "face") + " cut off from the seed of their part, given to the neighbours");
}

void list(const std::vector<Segment>& segments) {
  std::printf("label     faces    area\n");
  for (const Segment& s : segments) std::printf("%5zu %9zu %6.2f %%\n", s.label, s.faces, 100 * s.area);
}

/// Smooths and writes the boundaries and cuts them into the mesh, as far as asked for.
void treat_boundaries(const Options& options, mesh_files::Polygon_soup& soup, Oriented_mesh& input,
                      Segmentation& result, Stages& stages, Output_files& files) {
  if (!options.is_refined && options.boundaries.empty()) return;
  const auto callback = stages.start("boundaries");
  const Boundary_curves curves =
      boundary_curves(input.mesh, result.label, options.is_smooth || options.is_refined, callback);
  files.write_boundaries(curves);
  if (!options.is_refined) return;
  cut_boundaries(input.mesh, curves, result);
  soup = soup_of(input.mesh);
  input.mesh_face.assign(input.mesh.faces_begin(), input.mesh.faces_end());
}

template <class Policy>
void run(const Options& options, const Policy& numbers) {
  const std::vector<Seed_argument> seed_texts = seed_arguments(options);
  const Policy policy = policy_of(options, numbers);
  Stages stages(!options.is_quiet, is_interrupted);

  stages.start("reading");
  mesh_files::Polygon_soup soup = mesh_files::read_mesh(options.mesh);
  stages.start("repair");
  Oriented_mesh input = oriented_mesh(soup, options.repairs);
  stages.end();
  if (!options.is_quiet)
    for (const std::string& remark : input.remarks) say(options.mesh + ": " + remark);

  const std::vector<Face_label> seeds = seed_faces(seed_texts, input);
  // Before the first output is created, or a signal in between would leave it behind.
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  Output_files files(options);
  Segmentation result = segment(input.mesh, seeds, options, policy, stages);
  treat_boundaries(options, soup, input, result, stages, files);

  stages.start("writing");
  const std::vector<Segment> segments = segments_of(input.mesh, result.label);
  files.write(soup, faces_in_file_order(soup, input), result, segments);
  stages.end();
  files.commit(report_of(options, soup, input.remarks, policy, result, segments, stages.milliseconds()));

  if (options.is_quiet) return;
  say_what_is_odd(result);
  list(segments);
}

}  // namespace
}  // namespace segment_mesh

int main(int argc, char** argv) {
  using namespace segment_mesh;
  CLI::App app;
  Options options;
  define_command_line(app, options);
  try {
    app.parse(argc, argv);
    check_paths(options);
    check_combinations(options);
    if (options.is_engineering)
      run(options, RW_segmentation::Engineering_segmentation());
    else if (options.is_paper)
      run(options, RW_segmentation::Paper_segmentation());
    else
      run(options, default_policy(options));
    return success;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : wrong_usage;
  } catch (const mesh_files::Unreadable_file& error) {
    say(error.what());
    return unreadable_input;
  } catch (const std::invalid_argument& error) {
    say(options.mesh + ": " + error.what());
    return wrong_argument;
  } catch (const mesh_files::Unwritable_file& error) {
    say(error.what());
    return unwritable_output;
  } catch (const RW_segmentation::Cancelled&) {
    say("cancelled, nothing was written");
    return cancelled;
  } catch (const std::bad_alloc&) {
    say(options.mesh + ": out of memory");
    return failed_computation;
  } catch (const std::exception& error) {
    say(options.mesh + ": " + error.what());
    return failed_computation;
  }
}
