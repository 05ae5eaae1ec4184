// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_NUMBER_SAMPLE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_NUMBER_SAMPLE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A uniform sample of a set of numbers that does not depend on the order in which the set is put together: the numbers
/// that come first after scattering. Without duplicates, joined in linear time.
class Number_sample {
 public:
  using Number = std::uint32_t;

  Number_sample() = default;

  void insert(Number number, std::size_t most) { join(Number_sample(number * scatter), most); }

  void join(const Number_sample& other, std::size_t most) {
    std::vector<Number> all;
    all.reserve(scattered_.size() + other.scattered_.size());
    std::set_union(scattered_.begin(), scattered_.end(), other.scattered_.begin(), other.scattered_.end(),
                   std::back_inserter(all));
    if (all.size() > most) all.resize(most);
    scattered_ = std::move(all);
  }

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Number s : scattered_) visit(s * gather);
  }

  std::size_t size() const { return scattered_.size(); }

 private:
  explicit Number_sample(Number scattered) : scattered_(1, scattered) {}

  // A permutation of all numbers (Knuth), and its inverse.
  static constexpr Number scatter = 2654435761U, gather = 244002641U;
  static_assert(scatter * gather == 1U, "the second undoes the first");

  std::vector<Number> scattered_;  // ascending
};

}  // namespace RW_segmentation::internal

#endif
