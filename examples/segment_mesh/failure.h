// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_FAILURE_H
#define SEGMENT_MESH_FAILURE_H

#include "../mesh_files/Polygon_soup.h"
#include "Cad_format.h"
#include "Options.h"
#include "limits.h"
#include "signals.h"

#include <RW_segmentation/Progress.h>

#include <CLI/Error.hpp>

#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace segment_mesh {

/// Messages on standard error.
inline void say(const std::string& message) { std::fprintf(stderr, "segment_mesh: %s\n", message.c_str()); }

/// How the work on a mesh ended.
struct Outcome {
  Exit_code code = success;
  std::string message;
};

/// An error of the library, which knows nothing of options.
inline std::string in_words_of_options(std::string message, const Options& options) {
  const std::string tolerance = "the tolerance ";
  if (options.tolerance && message.compare(0, tolerance.size(), tolerance) == 0) {
    std::ostringstream words;
    words << "--tolerance " << *options.tolerance << ' ' << message.substr(tolerance.size())
          << ": it is larger than edges at the border";
    return words.str();
  }
  for (const auto& [words, option] :
       {std::pair<std::string, const char*>("the number of segments is ", "--segments is "),
        {"the number of seeds is ", "--seeds is "},
        {"seeds is ", "--seeds is "}})
    if (message.compare(0, words.size(), words) == 0) return option + message.substr(words.size());
  return message;
}

/// The outcome that the exception in flight stands for.
inline Outcome failure(const std::string& mesh, const Options& options) {
  try {
    throw;
  } catch (const CLI::ParseError& error) {
    return {wrong_usage, error.what()};
  } catch (const mesh_files::Unreadable_file& error) {
    return {unreadable_input, error.what()};
  } catch (const Argument_out_of_range& error) {
    return {wrong_argument, error.what()};
  } catch (const std::invalid_argument& error) {
    return {wrong_argument, mesh + ": " + in_words_of_options(error.what(), options)};
  } catch (const mesh_files::Unwritable_file& error) {
    return {unwritable_output, error.what()};
  } catch (const Unsound_shape& error) {
    return {unsound_shape, mesh + ": the CAD file would not be right, and nothing was written: " + error.what() +
                               " (--keep-invalid writes it all the same)"};
  } catch (const RW_segmentation::Cancelled&) {
    return {cancelled, std::string(cancelled_message)};
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

}  // namespace segment_mesh

#endif
