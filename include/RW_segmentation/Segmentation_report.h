// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENTATION_REPORT_H
#define RW_SEGMENTATION_SEGMENTATION_REPORT_H

#include <RW_segmentation/Segment_hierarchy.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What happened in a segmentation, and how long it took.
struct Segmentation_report {
  std::size_t components = 0;        ///< connected components of the mesh, which walls cut, too
  std::size_t seeds = 0;             ///< given and automatic ones
  std::size_t clusters = 0;          ///< that the walk was reduced to; 0 if it ran over the faces
  std::size_t fragments = 0;         ///< before merging
  std::size_t degenerate_faces = 0;  ///< faces without area
  std::size_t island_faces = 0;      ///< faces that the walk left apart from their fragment, moved to a neighbour
  bool has_heavy_noise = false;      ///< the vertices were smoothed to see the shape, see `Normal_smoothing`
  double noise = 0;                  ///< by surfaces: standard deviation of the vertices, in parts of the diagonal

  /// A stage of the computation.
  struct Stage {
    std::string name;  ///< what is done
    /// How long it took, or was waited for where others were done at the same time; its share of the time of all where
    /// components were segmented at the same time.
    double seconds;
  };
  std::vector<Stage> stages;  ///< in the order in which they happen
};

/// All levels of a segmentation, and a report of how it was made.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Random_walk_hierarchy : public Segment_hierarchy<FaceListGraph> {
 public:
  Random_walk_hierarchy() = default;
  /// Puts the two together.
  Random_walk_hierarchy(Segment_hierarchy<FaceListGraph> hierarchy, Segmentation_report report)
      : Segment_hierarchy<FaceListGraph>(std::move(hierarchy)), report_(std::move(report)) {}

  /// How the segmentation was made.
  const Segmentation_report& report() const { return report_; }

 private:
  Segmentation_report report_;
};

namespace internal {

/// Notes how long the stages of a computation take.
class Stage_clock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static Time now() { return std::chrono::steady_clock::now(); }
  static double seconds(Time begin, Time end) { return std::chrono::duration<double>(end - begin).count(); }

  /// \param begin of the first stage
  explicit Stage_clock(std::vector<Segmentation_report::Stage>& stages, Time begin = now())
      : stages_(stages), last_(begin) {}

  /// Ends a stage, which began where the one before it ended.
  void note(const char* stage);

 private:
  std::vector<Segmentation_report::Stage>& stages_;
  Time last_;
};

}  // namespace internal
}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Segmentation_report.h>
#endif

#endif
