// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_ARRAYS_H
#define RW_PYTHON_ARRAYS_H

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rw_python {

namespace nb = nanobind;

/// Labels, numbers of faces and of vertices.
using Integers = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// One number a face or an edge.
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// Pairs of vertices.
using Pairs = nb::ndarray<const std::int64_t, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
/// One row a face.
using Rows = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

template <class T>
using Array = nb::ndarray<nb::numpy, T, nb::ndim<1>>;
template <class T>
using Table = nb::ndarray<nb::numpy, T, nb::ndim<2>>;

/// Values as an array that owns them: they are not copied.
template <class T>
Array<T> array_of(std::vector<T>&& values) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return Array<T>(kept->data(), {kept->size()}, owner);
}

/// The same in rows.
/// \param rows how many, where there may be no columns
template <class T>
Table<T> table_of(std::vector<T>&& values, std::size_t columns, std::size_t rows = 0) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return Table<T>(kept->data(), {columns == 0 ? rows : kept->size() / columns, columns}, owner);
}

}  // namespace rw_python

#endif
