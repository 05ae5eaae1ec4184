// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_VALUE_GROUPS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_VALUE_GROUPS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

using Groups = std::vector<std::vector<std::size_t>>;

/// The groups of two or more values that hang together by being near.
template <class Value, class Near>
Groups connected_groups(const std::vector<Value>& values, const Near& near) {
  Groups groups;
  std::vector<bool> is_reached(values.size(), false);
  for (std::size_t first = 0; first < values.size(); ++first) {
    if (is_reached[first]) continue;
    is_reached[first] = true;
    std::vector<std::size_t> group = {first};
    for (std::size_t k = 0; k < group.size(); ++k)
      for (std::size_t i = first + 1; i < values.size(); ++i)
        if (!is_reached[i] && near(values[group[k]], group[k], values[i], i)) {
          is_reached[i] = true;
          group.push_back(i);
        }
    std::sort(group.begin(), group.end());
    if (group.size() > 1) groups.push_back(group);
  }
  return groups;
}

/// Sets the values of each group to their mean. Groups are those of two or more values that are near each other, each
/// to each, and whose mean is near no value outside, means of other groups included.
///
/// \param near `bool(value, number, other_value, other_number)`
/// \param mean `Value(group)`
template <class Value, class Near, class Mean>
Groups join_near_values(std::vector<Value>& values, const Near& near, const Mean& mean) {
  Groups groups = connected_groups(values, near);
  const auto is_loose = [&](const std::vector<std::size_t>& group) {
    return std::any_of(group.begin(), group.end(), [&](std::size_t i) {
      return std::any_of(group.begin(), group.end(),
                         [&](std::size_t j) { return i < j && !near(values[i], i, values[j], j); });
    });
  };
  groups.erase(std::remove_if(groups.begin(), groups.end(), is_loose), groups.end());

  std::vector<Value> joined;
  for (std::size_t before = groups.size() + 1; before != groups.size();) {
    before = groups.size();
    joined = values;
    std::vector<std::size_t> group_of(values.size(), groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::size_t i : groups[g]) {
        joined[i] = mean(groups[g]);
        group_of[i] = g;
      }
    const auto is_near_others = [&](const std::vector<std::size_t>& group) {
      return std::any_of(group.begin(), group.end(), [&](std::size_t i) {
        for (std::size_t k = 0; k < joined.size(); ++k)
          if (group_of[k] != group_of[i] && near(joined[i], i, joined[k], k)) return true;
        return false;
      });
    };
    groups.erase(std::remove_if(groups.begin(), groups.end(), is_near_others), groups.end());
  }
  values = joined;
  return groups;
}

}  // namespace RW_segmentation::internal

#endif
