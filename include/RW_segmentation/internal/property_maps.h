// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_PROPERTY_MAPS_H
#define RW_SEGMENTATION_INTERNAL_PROPERTY_MAPS_H

#include <RW_segmentation/internal/Argument_error.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace RW_segmentation::internal {

template <class Map, class Key, class Category, class = void>
struct Is_map : std::false_type {};
template <class Map, class Key, class Category>
struct Is_map<
    Map, Key, Category,
    std::void_t<typename boost::property_traits<Map>::category, typename boost::property_traits<Map>::key_type>>
    : std::bool_constant<std::is_convertible_v<typename boost::property_traits<Map>::category, Category> &&
                         std::is_convertible_v<Key, typename boost::property_traits<Map>::key_type>> {};

/// Whether `get(map, key)` may be called for keys of the type `Key`; false for what is no property map at all.
template <class Map, class Key>
constexpr bool is_readable_map = Is_map<Map, Key, boost::readable_property_map_tag>::value;

/// Whether `put(map, key, value)` may be called for keys of the type `Key`; false for what is no property map at all.
template <class Map, class Key>
constexpr bool is_writable_map = Is_map<Map, Key, boost::writable_property_map_tag>::value;

/// Refuses ids that do not fit into the integers of a map, where two of them could become the same. Negative ones, which are
/// large here, fit into signed integers.
/// \throws std::invalid_argument
template <class Map>
void require_ids_fit([[maybe_unused]] const std::vector<std::size_t>& ids) {
  using Id = typename boost::property_traits<Map>::value_type;
  if constexpr (std::is_integral_v<Id> && sizeof(Id) < sizeof(std::size_t))
    for (const std::size_t id : ids)
      if (static_cast<std::size_t>(static_cast<Id>(id)) != id)
        throw argument_error("a segment id", id, "a value of the map that it is written to");
}

}  // namespace RW_segmentation::internal

#endif
