// SPDX-License-Identifier: MIT

// Bytes as a file of each format, or of one that its first bytes tell: read into a sound soup, or refused with one line that names the file.

#include "../../examples/mesh_files.h"

#include "../three_mf_files.h"
#include "Fuzzed_input.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const auto read = [&]() -> mesh_files::Polygon_soup {
      const std::size_t size_of_a_piece = 1 + data[0] / 8 * std::size_t(16);
      switch (data[0] % 8) {
        case 0:
          return mesh_files::read_off("file", content, size_of_a_piece);
        case 1:
          return mesh_files::read_ply("file", content);
        case 2:
          return mesh_files::read_obj("file", content, size_of_a_piece);
        case 3:
          return mesh_files::read_stl("file", content);
        case 5:
          return mesh_files::read_msh("file", content);
        case 6:
          return mesh_files::read_medit("file", content);
        case 7:
          return mesh_files::read_vtp("file", content);
        default:  // packed or not, and whatever it begins with; or a model, whose sum in an archive no change would keep
          if (data[0] / 8 % 2 == 1)
            return mesh_files::read_3mf("file", three_mf_files::archive({{"3D/3dmodel.model", std::string(content)}}));
          return mesh_files::mesh_of_content("file", std::string(content));
      }
    };
    const mesh_files::Polygon_soup soup = read();
    for (const auto corner : soup.corners) fuzz::require(corner < soup.points.size(), "corners are points");
    for (const auto& p : soup.points)
      fuzz::require(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()), "points are finite");
    fuzz::require(soup.first_corner.back() == soup.corners.size(), "faces are made of all corners");
  } catch (const mesh_files::Unreadable_file& error) {
    const std::string what = error.what();
    fuzz::require(what.compare(0, 4, "file") == 0, "the error names the file");
    fuzz::require(what.find('\n') == std::string::npos, "the error is one line");
  }
  return 0;
}
