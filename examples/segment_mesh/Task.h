// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TASK_H
#define SEGMENT_MESH_TASK_H

#include "../mesh_files/Format.h"
#include "../mesh_files/Output_file.h"
#include "../mesh_files/Polygon_soup.h"
#include "../mesh_files/read_content.h"
#include "Options.h"

#include <CLI/Error.hpp>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace segment_mesh {

/// A mesh and its files.
struct Task {
  std::string mesh;
  Files files;
};

/// The file of materials beside an OBJ file.
inline std::string material_library_of(const std::string& obj) {
  return std::filesystem::path(obj).replace_extension(".mtl").string();
}

/// The files that are written for a mesh, each with its option. The folder of `--split` is none of them.
inline std::vector<std::pair<const char*, std::string>> written_files(const Files& files) {
  std::vector<std::pair<const char*, std::string>> written;
  for (const std::string& path : files.outputs) {
    written.emplace_back("--output", path);
    if (mesh_files::extension_of(path) == ".obj") written.emplace_back("--output", material_library_of(path));
  }
  for (const auto& [option, path] : {std::pair("--labels", files.labels),
                                     {"--left-out", files.left_out},
                                     {"--probabilities", files.probabilities},
                                     {"--hierarchy", files.hierarchy},
                                     {"--boundaries", files.boundaries},
                                     {"--html", files.html},
                                     {"--report", files.report}})
    if (!path.empty()) written.emplace_back(option, path);
  return written;
}

/// The name of a mesh without folder and extension, nor ".gz".
inline std::string name_of_mesh(const std::string& mesh) {
  if (mesh == mesh_files::standard_input) return "standard_input";
  const std::filesystem::path name = std::filesystem::path(mesh).filename();
  return (mesh_files::extension_of(name.string()) == ".gz" ? name.stem() : name).stem().string();
}

/// The folders on the way to a mesh, joined by "_", so that they tell meshes of the same name apart.
inline std::string folders_of_mesh(const std::string& mesh) {
  std::string joined;
  for (const std::filesystem::path& folder : std::filesystem::path(mesh).parent_path().relative_path())
    if (!folder.empty() && folder != "." && folder != "..") joined += (joined.empty() ? "" : "_") + folder.string();
  return joined;
}

/// A path by its pattern, in which `%` stands for the name of the mesh, `{folder}` for its folders and `%%` for "%".
inline std::string path_for(const std::string& mesh, const std::string& pattern) {
  constexpr std::string_view folder = "{folder}";
  std::string path;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern.compare(i, 2, "%%") == 0) {
      path += '%';
      ++i;
    } else if (pattern[i] == '%') {
      path += name_of_mesh(mesh);
    } else if (pattern.compare(i, folder.size(), folder) == 0) {
      path += folders_of_mesh(mesh);
      i += folder.size() - 1;
    } else {
      path += pattern[i];
    }
  }
  return path;
}

/// The files of a mesh by their patterns.
inline Files files_for(const std::string& mesh, Files patterns) {
  for (std::string& path : patterns.outputs) path = path_for(mesh, path);
  for (std::string* path :
       {&patterns.seeds, &patterns.constraints, &patterns.labels, &patterns.left_out, &patterns.split,
        &patterns.probabilities, &patterns.hierarchy, &patterns.boundaries, &patterns.html, &patterns.report})
    *path = path_for(mesh, *path);
  return patterns;
}

/// What is said where a percent sign behind a digit, as of a percentage, has become the name of the mesh; nothing if none has.
inline std::string remark_on_percentage(const Files& patterns, const std::string& mesh) {
  auto written = written_files(patterns);
  written.emplace_back("--split", patterns.split);
  for (const auto& [option, path] : written)
    for (std::size_t i = 1; i < path.size(); ++i)
      if (path[i] == '%' && path[i - 1] >= '0' && path[i - 1] <= '9' && path.compare(i, 2, "%%") != 0)
        return std::string(option) + " " + path + " is " + path_for(mesh, path) +
               ": % stands for the name of the mesh, and %% for a percent sign";
  return "";
}

/// The lines of a file, or of standard input for "-"; blank ones and those that start with `#` are passed over.
inline std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream file;
  if (path != "-") file.str(mesh_files::read_content(path));
  std::istream& lines = path == "-" ? std::cin : file;
  std::vector<std::string> result;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty() && line[0] != '#') result.push_back(line);
  }
  return result;
}

/// The path of the report with a line for each of several meshes; empty where each mesh has a report of its own. What is
/// resumed has several, of which one may be left.
inline std::string journal_of(const Options& options) {
  const std::string& report = options.files.report;
  const bool is_of_all = (options.has_several_meshes() || options.resumes) && !has_placeholder(report);
  return is_of_all ? path_for("", report) : std::string();
}

/// Refuses paths of which one would overwrite an input or another output. Links to one mesh are meshes of their own.
/// \param journal the report of all meshes, if there is one
inline void check_paths(const std::vector<Task>& tasks, const std::string& journal, const Options& options) {
  std::set<std::string> meshes, taken;
  const auto take = [&](const std::string& path) {
    std::error_code error;  // of pipes, which have names that lead nowhere
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
    return taken.insert(error ? path : canonical.string()).second;
  };
  for (const Task& task : tasks) {
    if (!meshes.insert(std::filesystem::absolute(task.mesh).lexically_normal().string()).second)
      throw CLI::ValidationError("MESH", task.mesh + " is given twice");
    for (const std::string& input : {task.mesh, task.files.seeds, task.files.constraints})
      if (!input.empty()) take(input);
  }
  for (const std::string& input : {options.list, options.page})
    if (!input.empty() && input != mesh_files::standard_input) take(input);
  if (!journal.empty() && !take(journal))
    throw CLI::ValidationError("--report", journal + " is an input or another output");
  for (const Task& task : tasks) {
    for (const auto& [option, path] : written_files(task.files))
      if (!take(path)) throw CLI::ValidationError(option, path + " is an input or another output");
    if (!task.files.split.empty() && !take(task.files.split))
      throw CLI::ValidationError("--split", task.files.split + " is an input or another output");
  }
}

/// Refuses outputs that several meshes would share, and folders that are not there.
inline void check_patterns(const Files& patterns) {
  auto written = written_files(patterns);
  if (!patterns.split.empty()) written.emplace_back("--split", patterns.split);
  for (const auto& [option, path] : written) {
    if (!has_placeholder(path))
      throw CLI::ValidationError(option, path + ": several meshes need a % in it, which stands for their names");
    const std::string pattern = std::filesystem::path(path).parent_path().string();
    if (!has_placeholder(pattern) && !pattern.empty() && !std::filesystem::is_directory(path_for("", pattern)))
      throw mesh_files::Unwritable_file(path + ": there is no such folder");
  }
}

/// The meshes that are to be segmented, each with the names of its files.
/// \throws CLI::ValidationError, mesh_files::Unreadable_file, mesh_files::Unwritable_file
inline std::vector<Task> tasks_of(const Options& options) {
  std::vector<std::string> meshes = options.meshes;
  if (options.list == mesh_files::standard_input &&
      std::find(meshes.begin(), meshes.end(), mesh_files::standard_input) != meshes.end())
    throw CLI::ValidationError("--list", "standard input is a mesh or a list of meshes, not both");
  if (!options.list.empty())
    for (const std::string& line : lines_of(options.list)) meshes.push_back(line);
  if (meshes.empty() && options.list.empty()) throw CLI::RequiredError("a mesh");

  Files patterns = options.files;
  if (!journal_of(options).empty()) patterns.report.clear();
  if (options.has_several_meshes()) check_patterns(patterns);
  if (options.resumes && written_files(patterns).empty() && patterns.split.empty())
    throw CLI::ValidationError("--resume", "no file tells which meshes are done: give an output for each mesh");
  std::vector<Task> tasks;
  tasks.reserve(meshes.size());
  for (const std::string& mesh : meshes) tasks.push_back({mesh, files_for(mesh, patterns)});
  check_paths(tasks, journal_of(options), options);
  return tasks;
}

/// Whether something is written to standard output, so that nothing else may be.
inline bool writes_to_standard_output(const Files& files) {
  const auto written = written_files(files);
  return std::any_of(written.begin(), written.end(),
                     [](const auto& file) { return mesh_files::open_file_of(file.second) == STDOUT_FILENO; });
}

/// Whether all files of a mesh are there and none is older than it or another file that it was made of.
inline bool is_done(const Task& task, const Options& options) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::file_time_type time_of_inputs = fs::file_time_type::min();
  for (const std::string& input : {task.mesh, task.files.seeds, task.files.constraints, options.page}) {
    if (input.empty()) continue;
    time_of_inputs = std::max(time_of_inputs, fs::last_write_time(input, error));
    if (error) return false;
  }
  const auto is_new = [&](const fs::path& path) {
    const fs::file_time_type time = fs::last_write_time(path, error);
    return !error && time >= time_of_inputs;
  };
  const auto written = written_files(task.files);
  if (!std::all_of(written.begin(), written.end(), [&](const auto& file) { return is_new(file.second); })) return false;
  if (task.files.split.empty()) return true;
  const fs::directory_iterator parts(task.files.split, error);
  // A part that has not got its name yet was left by a program that was killed.
  return !error && parts != fs::directory_iterator() && std::all_of(begin(parts), end(parts), [&](const auto& part) {
    return part.path().string().find(".part", task.files.split.size()) == std::string::npos && is_new(part.path());
  });
}

}  // namespace segment_mesh

#endif
