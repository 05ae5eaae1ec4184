// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SEGMENTS_H
#define SEGMENT_MESH_SEGMENTS_H

#include "../mesh_files/Colors.h"
#include "Oriented_mesh.h"
#include "Segmentation.h"
#include "segment_colors.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace segment_mesh {

/// A segment as it is listed and reported.
struct Segment {
  std::size_t label = 0;
  std::size_t faces = 0;
  double area = 0;  ///< as a part of the whole
  mesh_files::Color color{};
};

/// Counts, areas and colours of the segments, in the order of their labels.
inline std::vector<Segment> segments_of(const Mesh& mesh, const std::vector<std::size_t>& label) {
  std::vector<std::size_t> labels = label;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::vector<Segment> segments(labels.size());
  std::vector<std::size_t> id(label.size());

  const double extent = extent_of(mesh);
  double total_area = 0;
  for (const auto f : mesh.faces()) {
    id[f] = static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label[f]) - labels.begin());
    const double area = extent > 0 ? face_area(mesh, f, extent) : 0;
    ++segments[id[f]].faces;
    segments[id[f]].area += area;
    total_area += area;
  }
  const auto colors = segment_colors(mesh, id, labels.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    segments[s].label = labels[s];
    segments[s].color = colors[s];
    if (total_area > 0) segments[s].area /= total_area;
  }
  return segments;
}

/// The segments with the numbers of faces that have their labels in the file, faces included that a repair leaves out. A
/// segment is left out, too, if it has none: the parts of a face that touches itself may have several labels.
/// \param labels in the order of the file
inline std::vector<Segment> counted_in_file(std::vector<Segment> segments, const std::vector<std::size_t>& labels) {
  for (Segment& s : segments) s.faces = 0;
  for (const std::size_t label : labels) {
    const auto found = std::lower_bound(segments.begin(), segments.end(), label,
                                        [](const Segment& s, std::size_t wanted) { return s.label < wanted; });
    ++found->faces;
  }
  segments.erase(std::remove_if(segments.begin(), segments.end(), [](const Segment& s) { return s.faces == 0; }),
                 segments.end());
  return segments;
}

}  // namespace segment_mesh

#endif
