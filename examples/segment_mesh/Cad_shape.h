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
#include <memory>
#include <string>
#include <vector>

namespace segment_mesh {

/// The segments of a mesh as a CAD system has them. The one file that knows Open CASCADE, Cad_shape.cpp, defines this.
class Cad_shape {
 public:
  /// \param surfaces by segment
  /// \param unit of the mesh's coordinates
  Cad_shape(const RW_segmentation::Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face,
            const std::vector<RW_segmentation::Analytic_surface>& surfaces, const Length_unit& unit,
            const std::function<bool(double)>& callback);
  Cad_shape(const Cad_shape&) = delete;
  Cad_shape& operator=(const Cad_shape&) = delete;
  ~Cad_shape();

  /// Why the shape does not stand for the mesh; empty if it does.
  std::string defect() const;

  /// What became of the mesh, by face, too; lengths are in millimetres.
  nlohmann::ordered_json report() const;

  /// The content of a file in which solids have the name of the mesh, and faces the names and colours of their segments.
  /// \param color_of_segment by segment
  std::string content(Cad_format format, const std::string& name,
                      const std::vector<mesh_files::Color>& color_of_segment) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  Length_unit unit_;
};

}  // namespace segment_mesh

#endif
