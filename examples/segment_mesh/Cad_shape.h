// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CAD_SHAPE_H
#define SEGMENT_MESH_CAD_SHAPE_H

#include "../mesh_files/Colors.h"
#include "Cad_format.h"

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace segment_mesh {

/// The segments of a mesh as a CAD system has them.
class Cad_shape {
 public:
  Cad_shape(const Cad_shape&) = delete;
  Cad_shape& operator=(const Cad_shape&) = delete;
  virtual ~Cad_shape() = default;

  /// Why the shape does not stand for the mesh; empty if it does.
  virtual std::string defect() const = 0;

  /// What became of the mesh, by face, too; lengths are in millimetres.
  virtual nlohmann::ordered_json report() const = 0;

  /// The content of a file in which solids have the name of the mesh, and faces the names and colours of their segments.
  /// \param color_of_segment by segment
  virtual std::string content(Cad_format format, const std::string& name,
                              const std::vector<mesh_files::Color>& color_of_segment) const = 0;

 protected:
  Cad_shape() = default;
};

}  // namespace segment_mesh

/// Makes the shape of a mesh, which the caller deletes. The one file that knows Open CASCADE, Cad_shape.cpp, defines it;
/// its name is that of a function of C, by which a library is asked for it.
/// \param surfaces by segment
/// \param unit of the mesh's coordinates
extern "C" segment_mesh::Cad_shape* segment_mesh_new_cad_shape(
    const RW_segmentation::Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face,
    const std::vector<RW_segmentation::Analytic_surface>& surfaces, const segment_mesh::Length_unit& unit,
    const std::function<bool(double)>& callback);

#endif
