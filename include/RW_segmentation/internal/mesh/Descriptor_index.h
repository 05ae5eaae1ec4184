// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_DESCRIPTOR_INDEX_H
#define RW_SEGMENTATION_INTERNAL_MESH_DESCRIPTOR_INDEX_H

#include <boost/functional/hash.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

template <class Descriptor, class = void>
struct Has_integer : std::false_type {};
template <class Descriptor>
struct Has_integer<Descriptor, std::void_t<decltype(std::declval<const Descriptor&>().idx())>> : std::true_type {};

/// A value for each vertex, edge or face of a mesh: an array where descriptors hold an integer (`Surface_mesh`, OpenMesh), a
/// hash table where they are handles (`Polyhedron_3`).
///
/// Ids stored in the mesh are not used: they may be missing, not initialised, or leave gaps after a removal.
template <class Descriptor, class Value>
class Descriptor_table {
 public:
  /// The table that gives every descriptor the value `absent`.
  explicit Descriptor_table(Value absent) : absent_(absent) {}

  void reserve(std::size_t number) { values_.reserve(number); }

  void insert(const Descriptor& descriptor, Value value) {
    if constexpr (Has_integer<Descriptor>::value) {
      const auto position = static_cast<std::size_t>(descriptor.idx());
      if (position >= values_.size()) values_.resize(position + 1, absent_);
      values_[position] = value;
    } else {
      values_.insert_or_assign(descriptor, value);
    }
  }

  /// The value inserted for the descriptor, `absent` if there is none.
  Value operator[](const Descriptor& descriptor) const {
    if constexpr (Has_integer<Descriptor>::value) {
      // A null descriptor is a negative or an enormous integer: both fail the comparison.
      const auto position = static_cast<std::size_t>(descriptor.idx());
      return position < values_.size() ? values_[position] : absent_;
    } else {
      const auto found = values_.find(descriptor);
      return found == values_.end() ? absent_ : found->second;
    }
  }

 private:
  std::conditional_t<Has_integer<Descriptor>::value, std::vector<Value>,
                     std::unordered_map<Descriptor, Value, boost::hash<Descriptor>>>
      values_;
  Value absent_;
};

/// Numbers 0, 1, ... for the vertices, edges or faces of a mesh.
template <class Descriptor>
class Descriptor_index : public Descriptor_table<Descriptor, std::uint32_t> {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

  Descriptor_index() : Descriptor_table<Descriptor, Index>(none) {}
};

}  // namespace RW_segmentation::internal

#endif
