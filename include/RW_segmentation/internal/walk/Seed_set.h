// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SEED_SET_H
#define RW_SEGMENTATION_INTERNAL_WALK_SEED_SET_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace RW_segmentation::internal {

/// The faces where walks end and their labels, with a note of the labels that edits have touched.
class Seed_set {
 public:
  using Index = Dual_graph::Index;
  using Label = std::size_t;
  struct Seed {
    Index face;
    Label label;
  };

  /// A face that is a seed already takes the new label.
  void add(Index face, Label label) {
    const auto known = label_of_.find(face);
    if (known != label_of_.end() && known->second == label) return;
    // Whatever needs memory comes first. A label that is noted for nothing does no harm.
    changed_labels_.push_back(label);
    if (known != label_of_.end()) {
      changed_labels_.push_back(known->second);
      known->second = find(face)->label = label;
    } else {
      if (seeds_.size() == seeds_.capacity()) seeds_.reserve(2 * seeds_.size() + 1);
      label_of_.emplace(face, label);
      seeds_.push_back({face, label});
    }
  }

  /// \returns whether the face was a seed
  bool remove(Index face) {
    if (!contains(face)) return false;
    changed_labels_.push_back(label_of(face));
    label_of_.erase(face);
    seeds_.erase(find(face));
    return true;
  }

  void clear() {
    for (const Seed& seed : seeds_) changed_labels_.push_back(seed.label);
    seeds_.clear();
    label_of_.clear();
  }

  /// In the order in which they were added.
  const std::vector<Seed>& seeds() const { return seeds_; }
  std::size_t size() const { return seeds_.size(); }
  bool empty() const { return seeds_.empty(); }
  bool contains(Index face) const { return label_of_.count(face) > 0; }
  /// Of a face that is a seed.
  Label label_of(Index face) const { return label_of_.at(face); }
  std::optional<Label> find_label_of(Index face) const {
    const auto found = label_of_.find(face);
    return found == label_of_.end() ? std::nullopt : std::optional<Label>(found->second);
  }

  /// In the order in which they were added.
  std::vector<Index> faces() const {
    std::vector<Index> result;
    for (const Seed& seed : seeds_) result.push_back(seed.face);
    return result;
  }

  /// Ascending, each once.
  std::vector<Label> labels() const {
    std::vector<Label> result;
    for (const Seed& seed : seeds_) result.push_back(seed.label);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// Those with seeds that have come, gone or changed since the last call of `forget_changes()`.
  const std::vector<Label>& changed_labels() const { return changed_labels_; }
  void forget_changes() { changed_labels_.clear(); }

 private:
  std::vector<Seed>::iterator find(Index face) {
    return std::find_if(seeds_.begin(), seeds_.end(), [&](const Seed& seed) { return seed.face == face; });
  }

  std::vector<Seed> seeds_;
  std::unordered_map<Index, Label> label_of_;
  std::vector<Label> changed_labels_;
};

}  // namespace RW_segmentation::internal

#endif
