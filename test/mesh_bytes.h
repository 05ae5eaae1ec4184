// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_MESH_BYTES_H
#define RW_SEGMENTATION_TEST_MESH_BYTES_H

#include "../examples/mesh_files/Polygon_soup.h"

#include <boost/endian/conversion.hpp>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

/// What tests make files of meshes from.
namespace mesh_bytes {

using Point = mesh_files::Polygon_soup::Point;
using Faces = std::vector<std::vector<std::size_t>>;
using Order = boost::endian::order;

inline const std::vector<Point> tetrahedron_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
inline const Faces tetrahedron_faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

/// The values as they lie in a binary file.
template <class Value>
std::string bytes(std::initializer_list<Value> values, Order order = Order::little) {
  std::string result;
  for (const Value value : values) {
    std::array<unsigned char, sizeof(Value)> b;
    if (order == Order::little)
      boost::endian::endian_store<Value, sizeof(Value), Order::little>(b.data(), value);
    else
      boost::endian::endian_store<Value, sizeof(Value), Order::big>(b.data(), value);
    result.append(b.begin(), b.end());
  }
  return result;
}

}  // namespace mesh_bytes

#endif
