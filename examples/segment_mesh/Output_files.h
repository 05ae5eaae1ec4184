// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_OUTPUT_FILES_H
#define SEGMENT_MESH_OUTPUT_FILES_H

#include "../mesh_files/Format.h"
#include "../mesh_files/Output_file.h"
#include "../mesh_files/Polygon_soup.h"
#include "../mesh_files/Segmented_soup.h"
#include "Boundaries.h"
#include "Cad_shape.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Segmentation.h"
#include "Task.h"
#include "close_parts.h"
#include "segments.h"
#include "walls.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace segment_mesh {

class Html_page;

/// For each face of the file the face of the mesh that speaks for it: its own, or the closest one where a repair left
/// it out.
std::vector<Mesh::Face_index> faces_in_file_order(const mesh_files::Polygon_soup& soup, const Oriented_mesh& input);

/// The values of the mesh's faces in the order of the file.
template <class Value>
std::vector<Value> in_file_order(const std::vector<Mesh::Face_index>& faces, const std::vector<Value>& values) {
  std::vector<Value> result;
  result.reserve(faces.size());
  for (const auto f : faces) result.push_back(values[f]);
  return result;
}

/// The files asked for. They are created before the work, so that a wrong folder is found out at once, and appear
/// together at its end.
class Output_files {
 public:
  Output_files(const Files& files, const Options& options);
  ~Output_files();
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;

  /// \param closed what is written in place of the mesh where parts are closed; may be null
  void write(const mesh_files::Polygon_soup& soup, const Closed_parts* closed,
             const std::vector<Mesh::Face_index>& faces, const Segmentation& result,
             const std::vector<Segment>& segments);

  /// \param faces the numbers of the faces of the file that the mesh lacks
  void write_left_out(const std::vector<std::size_t>& faces);

  void write_page(const std::string& path, const Mesh& mesh, const Wall_map& walls, const Segmentation& result,
                  std::size_t segments);

  void write_boundaries(const Boundary_curves& curves);

  /// \param name of the solid
  void write_cad_files(const Cad_shape& shape, const std::string& name, const std::vector<Segment>& segments);

  /// Gives the files their names.
  void commit(const nlohmann::ordered_json& report);

 private:
  /// A mesh with a label for each face.
  struct Mesh_with_labels {
    const mesh_files::Polygon_soup& soup;
    const std::vector<std::size_t>& labels;
  };

  mesh_files::Output_file& create(const std::string& path) { return open_.emplace_back(path); }
  mesh_files::Output_file& file(const std::string& path);
  void write_meshes(const Mesh_with_labels& whole, const Mesh_with_labels& parts, const std::vector<Segment>& segments);
  void write_mesh(mesh_files::Output_file& file, Output_format format, const mesh_files::Segmented_soup& mesh) const;
  void write_probabilities(const std::vector<Mesh::Face_index>& faces, const Segmentation& result);
  void write_labels(const std::vector<std::size_t>& labels);
  void write_parts(const Mesh_with_labels& parts, const std::vector<Segment>& segments);

  const Files& files_;
  const Options& options_;
  std::unique_ptr<const Html_page> page_;
  std::optional<mesh_files::Output_folder> split_;  // outlives the files in it
  std::deque<mesh_files::Output_file> open_;
};

}  // namespace segment_mesh

#endif
