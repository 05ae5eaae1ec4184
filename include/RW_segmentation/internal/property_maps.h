// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_PROPERTY_MAPS_H
#define RW_SEGMENTATION_INTERNAL_PROPERTY_MAPS_H

#include <boost/property_map/property_map.hpp>

#include <type_traits>

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

}  // namespace RW_segmentation::internal

#endif
