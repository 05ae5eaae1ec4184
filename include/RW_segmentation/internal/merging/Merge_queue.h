// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MERGING_MERGE_QUEUE_H
#define RW_SEGMENTATION_INTERNAL_MERGING_MERGE_QUEUE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace RW_segmentation::internal {

/// Boundaries between regions by what it costs to merge over them: a heap whose costs change. Of equal costs the boundary
/// with the lowest number comes first.
///
/// The heap is Boost's, out of sight of programs that link the compiled library: its headers bring Boost.Parameter,
/// Boost.MP11 and Boost.Bind.
class Merge_queue {
 public:
  using Index = std::uint32_t;

  struct Candidate {
    double cost;
    Index boundary;
  };

  /// An empty one, to be assigned to.
  Merge_queue();
  /// Complexity: linearithmic.
  /// \param costs by boundary, not NaN
  explicit Merge_queue(const std::vector<double>& costs);
  ~Merge_queue();
  Merge_queue(Merge_queue&&) noexcept;
  Merge_queue& operator=(Merge_queue&&) noexcept;

  bool empty() const;
  /// The boundary that costs least.
  Candidate top() const;
  /// Complexity: logarithmic.
  void update(Index boundary, double cost);
  /// Complexity: logarithmic.
  void erase(Index boundary);

 private:
  struct Heap;
  std::unique_ptr<Heap> heap_;
};

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Merge_queue.h>
#endif

#endif
