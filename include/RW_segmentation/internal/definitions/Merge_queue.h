// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_MERGE_QUEUE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_MERGE_QUEUE_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Merge_queue.h>

#include <boost/heap/d_ary_heap.hpp>

#include <memory>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

struct Merge_queue::Heap {
  struct Comes_later {  // the heap's top is the largest
    bool operator()(const Candidate& a, const Candidate& b) const {
      return std::tie(b.cost, b.boundary) < std::tie(a.cost, a.boundary);
    }
  };
  using Queue = boost::heap::d_ary_heap<Candidate, boost::heap::arity<4>, boost::heap::mutable_<true>,
                                        boost::heap::compare<Comes_later>>;

  Queue queue;
  std::vector<Queue::handle_type> place;  // of each boundary
};

RW_SEGMENTATION_INLINE Merge_queue::Merge_queue(const std::vector<double>& costs) : heap_(std::make_unique<Heap>()) {
  heap_->queue.reserve(costs.size());
  heap_->place.reserve(costs.size());
  for (Index b = 0; b < costs.size(); ++b) heap_->place.push_back(heap_->queue.push({costs[b], b}));
}

RW_SEGMENTATION_INLINE Merge_queue::Merge_queue() = default;
RW_SEGMENTATION_INLINE Merge_queue::~Merge_queue() = default;
RW_SEGMENTATION_INLINE Merge_queue::Merge_queue(Merge_queue&&) noexcept = default;
RW_SEGMENTATION_INLINE Merge_queue& Merge_queue::operator=(Merge_queue&&) noexcept = default;

RW_SEGMENTATION_INLINE bool Merge_queue::empty() const { return heap_->queue.empty(); }
RW_SEGMENTATION_INLINE Merge_queue::Candidate Merge_queue::top() const { return heap_->queue.top(); }
RW_SEGMENTATION_INLINE void Merge_queue::update(Index boundary, double cost) {
  heap_->queue.update(heap_->place[boundary], {cost, boundary});
}
RW_SEGMENTATION_INLINE void Merge_queue::erase(Index boundary) { heap_->queue.erase(heap_->place[boundary]); }

}  // namespace RW_segmentation::internal

#endif
