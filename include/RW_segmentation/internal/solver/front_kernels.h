// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SOLVER_FRONT_KERNELS_H
#define RW_SEGMENTATION_INTERNAL_SOLVER_FRONT_KERNELS_H

#include <RW_segmentation/internal/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

// The dense arithmetic of the star-mesh elimination, compiled for several instruction sets of which the running
// machine's best is taken, so that a program built without -march=native still uses FMA and wide registers.
#if (defined(__GNUC__) || defined(__clang__)) && defined(__x86_64__)
#define RW_SEGMENTATION_X86_DISPATCH
#define RW_SEGMENTATION_ALWAYS_INLINE inline __attribute__((always_inline))
#elif defined(__GNUC__) || defined(__clang__)
#define RW_SEGMENTATION_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define RW_SEGMENTATION_ALWAYS_INLINE inline
#endif

namespace RW_segmentation::internal {

/// One dense front: `pivots` columns to eliminate and `rows` more that stay, as conductances below the diagonal.
struct Front {
  std::size_t pivots, rows;
  double* panel;                   ///< (pivots + rows) x pivots, column by column: conductances, later used up
  double* remainder;               ///< rows x rows, column by column, lower triangle: what is left for the parent
  const std::uint32_t* absorbing;  ///< by pivot: not 0 for a seed, whose column keeps its conductances
  double* ground;                  ///< by row of the front: conductance to earlier seeds; null where there is none
  double* sum;                     ///< out, by pivot: d_k
  double* transition;              ///< out, packed columns below the diagonal: p_ki, or c_ki for a seed
  double* scaled;                  ///< scratch, (pivots + rows) x block
  double* packed;                  ///< scratch, see `kernel::packed_size`
};

constexpr std::size_t front_block = 32;  // pivots eliminated before the rest of the front is brought up to date

namespace kernel {

// A tile of the product is held in registers: two vectors high, four columns wide. The compiler splits vectors that are
// longer than the registers badly, so each instruction set has its own length.
constexpr std::size_t longest_vector = 8, tile_columns = 4;
constexpr std::size_t tiles_at_a_time = 8;  // whose packed rows fit in 32 KB; benchmark_seed_editing: a redo

/// Scratch for the columns of an `Outer_product`.
constexpr std::size_t packed_size(std::size_t largest_front) { return (largest_front + tile_columns) * front_block; }

/// tile = the product of packed strips a (depth x 2 vectors) and b (depth x 4).
template <std::size_t vector_length>
RW_SEGMENTATION_ALWAYS_INLINE void multiply_tile(const double* a, const double* b, std::size_t depth,
                                                 double (&tile)[tile_columns][2 * vector_length]) {
#if defined(__GNUC__) || defined(__clang__)
  using Vector __attribute__((vector_size(vector_length * sizeof(double)), aligned(8))) = double;
  Vector c[tile_columns][2] = {};
  for (std::size_t k = 0; k < depth; ++k, a += 2 * vector_length, b += tile_columns) {
    Vector low, high;
    std::memcpy(&low, a, sizeof low);
    std::memcpy(&high, a + vector_length, sizeof high);
    for (std::size_t j = 0; j < tile_columns; ++j) {
      c[j][0] += low * b[j];
      c[j][1] += high * b[j];
    }
  }
  std::memcpy(&tile, &c, sizeof c);
#else
  for (auto& column : tile) std::fill(std::begin(column), std::end(column), 0.);
  for (std::size_t k = 0; k < depth; ++k, a += 2 * vector_length, b += tile_columns)
    for (std::size_t j = 0; j < tile_columns; ++j)
      for (std::size_t i = 0; i < 2 * vector_length; ++i) tile[j][i] += a[i] * b[j];
#endif
}

/// z(i, j) += sum_k y(i, k) p(j, k) for j < columns, j <= i < rows, k < depth; y and p have the same leading dimension.
struct Outer_product {
  double* z;
  std::size_t z_stride;
  const double *y, *p;
  std::size_t stride, rows, columns, depth;
};

inline bool is_small(const Outer_product& product) { return product.rows < 24 || product.depth < 4; }

/// Adds a small product as it stands.
RW_SEGMENTATION_ALWAYS_INLINE void add_small_product(const Outer_product& product) {
  const double *y = product.y, *p = product.p;
  for (std::size_t k = 0; k < product.depth; ++k, y += product.stride, p += product.stride)
    for (std::size_t j = 0; j < product.columns; ++j) {
      const double factor = p[j];
      double* column = product.z + j * product.z_stride;
      for (std::size_t i = j; i < product.rows; ++i) column[i] += y[i] * factor;
    }
}

/// Packs p into strips of a tile's columns.
RW_SEGMENTATION_ALWAYS_INLINE void pack_columns(const Outer_product& product, double* packed) {
  for (std::size_t j = 0; j < product.columns; j += tile_columns)
    for (std::size_t k = 0; k < product.depth; ++k)
      for (std::size_t t = 0; t < tile_columns; ++t)
        packed[j * product.depth + k * tile_columns + t] =
            j + t < product.columns ? product.p[k * product.stride + j + t] : 0;
}

/// Packs rows of y into strips of a tile's height.
template <std::size_t tile_rows>
RW_SEGMENTATION_ALWAYS_INLINE void pack_rows(const Outer_product& product, std::size_t begin, std::size_t end,
                                             double* strip) {
  for (std::size_t i = begin; i < end; i += tile_rows, strip += tile_rows * product.depth) {
    const std::size_t height = std::min(tile_rows, product.rows - i);
    for (std::size_t k = 0; k < product.depth; ++k)
      for (std::size_t t = 0; t < tile_rows; ++t)
        strip[k * tile_rows + t] = t < height ? product.y[k * product.stride + i + t] : 0;
  }
}

/// Adds the rows from `begin`, a multiple of a tile's rows, to less than `end`. Some tiles below one another come before
/// those to their right, so that more than one line of the cache is read from each column of z at a time.
template <std::size_t vector_length>
RW_SEGMENTATION_ALWAYS_INLINE void add_rows(const Outer_product& product, const double* packed, std::size_t begin,
                                            std::size_t end) {
  constexpr std::size_t tile_rows = 2 * vector_length, rows_at_a_time = tiles_at_a_time * tile_rows;
  const std::size_t depth = product.depth;
  double strips[rows_at_a_time * front_block];
  for (std::size_t first = begin; first < end; first += rows_at_a_time) {
    const std::size_t behind = std::min(first + rows_at_a_time, end);
    pack_rows<tile_rows>(product, first, behind, strips);
    for (std::size_t j = 0; j < std::min(product.columns, behind); j += tile_columns)
      for (std::size_t i = std::max(first, j / tile_rows * tile_rows); i < behind; i += tile_rows) {
        double tile[tile_columns][tile_rows];
        multiply_tile<vector_length>(strips + (i - first) * depth, packed + j * depth, depth, tile);
        const std::size_t height = std::min(tile_rows, product.rows - i);
        const std::size_t width = std::min(tile_columns, std::min(product.columns, i + height) - j);
        for (std::size_t t = 0; t < width; ++t) {
          double* column = product.z + (j + t) * product.z_stride + i;
          for (std::size_t s = i < j + t ? j + t - i : 0; s < height; ++s) column[s] += tile[t][s];
        }
      }
  }
}

/// What a block of eliminated pivots adds to the pivots left.
inline Outer_product update_of_pivots(const Front& front, std::size_t begin, std::size_t end) {
  const std::size_t size = front.pivots + front.rows;
  return {front.panel + end * size + end,
          size,
          front.panel + begin * size + end,
          front.scaled + end,
          size,
          size - end,
          front.pivots - end,
          end - begin};
}

/// What a block of eliminated pivots adds to the rows.
inline Outer_product update_of_rows(const Front& front, std::size_t begin, std::size_t end) {
  const std::size_t size = front.pivots + front.rows;
  return {front.remainder,
          front.rows,
          front.panel + begin * size + front.pivots,
          front.scaled + front.pivots,
          size,
          front.rows,
          front.rows,
          end - begin};
}

/// Star-mesh transforms of a block of pivots in turn, which bring the block itself up to date. Only sums, products and
/// quotients of non-negative numbers: no digit is ever cancelled.
/// \param transition where the block's columns of the result begin
/// \returns where they end
RW_SEGMENTATION_ALWAYS_INLINE double* eliminate_block(const Front& front, std::size_t begin, std::size_t end,
                                                      double* transition) {
  const std::size_t size = front.pivots + front.rows;
  for (std::size_t k = begin; k < end; ++k) {
    const double* c = front.panel + k * size;
    double* p = front.scaled + (k - begin) * size;
    if (front.absorbing[k]) {
      if (front.ground)
        for (std::size_t i = k + 1; i < size; ++i) front.ground[i] += c[i];
      transition = std::copy(c + k + 1, c + size, transition);
      std::fill(p + k + 1, p + size, 0.);
      front.sum[k] = 0;
      continue;
    }
    double d = front.ground ? front.ground[k] : 0;
    for (std::size_t i = k + 1; i < size; ++i) d += c[i];
    front.sum[k] = d;
    if (d > 1e-290) {
      const double inverse = 1 / d;
      for (std::size_t i = k + 1; i < size; ++i) p[i] = c[i] * inverse;
    } else {  // the reciprocal would overflow, or the pivot is cut off from everything left
      for (std::size_t i = k + 1; i < size; ++i) p[i] = d > 0 ? c[i] / d : 0;
    }
    if (front.ground && front.ground[k] > 0)
      for (std::size_t i = k + 1; i < size; ++i) front.ground[i] += p[i] * front.ground[k];
    transition = std::copy(p + k + 1, p + size, transition);
    for (std::size_t j = k + 1; j < end; ++j) {
      const double factor = p[j];
      double* column = front.panel + j * size;
      for (std::size_t i = j + 1; i < size; ++i) column[i] += c[i] * factor;
    }
  }
  return transition;
}

template <std::size_t vector_length>
RW_SEGMENTATION_ALWAYS_INLINE void add_outer_product(const Outer_product& product, double* packed) {
  if (is_small(product)) return add_small_product(product);
  pack_columns(product, packed);
  add_rows<vector_length>(product, packed, 0, product.rows);
}

/// Eliminates all pivots of a front.
template <std::size_t vector_length>
RW_SEGMENTATION_ALWAYS_INLINE void eliminate(const Front& front) {
  double* transition = front.transition;
  for (std::size_t begin = 0; begin < front.pivots; begin += front_block) {
    const std::size_t end = std::min(front.pivots, begin + front_block);
    transition = eliminate_block(front, begin, end, transition);
    if (end < front.pivots) add_outer_product<vector_length>(update_of_pivots(front, begin, end), front.packed);
    if (front.rows > 0) add_outer_product<vector_length>(update_of_rows(front, begin, end), front.packed);
  }
}

/// Asks for the part of the factor that substitution reads after the one at `p`. It goes from the end of the factor to its
/// beginning, but forward in each column, in which processors see no stream. May lie before the factor, which is no error.
RW_SEGMENTATION_ALWAYS_INLINE void prefetch_earlier([[maybe_unused]] const double* p) {
#if defined(__GNUC__) || defined(__clang__)
  constexpr std::uintptr_t distance = 8192;  // bytes; benchmark_seed_editing: 4096 to 12288 do as well
  const auto address = reinterpret_cast<std::uintptr_t>(p) - distance;
  __builtin_prefetch(reinterpret_cast<const void*>(address));  // NOLINT(performance-no-int-to-ptr): maybe of no object
#endif
}

RW_SEGMENTATION_ALWAYS_INLINE double dot_product(const double* a, const double* b, std::size_t length) {
  // Eight sums: one would make each addition wait for the one before.
  double sum[8] = {}, rest = 0;
  std::size_t i = 0;
  for (; i + 8 <= length; i += 8) {
    prefetch_earlier(a + i + 8);
    for (std::size_t t = 0; t < 8; ++t) sum[t] += a[i + t] * b[i + t];
  }
  for (; i < length; ++i) rest += a[i] * b[i];
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7])) + rest;
}

/// Back-substitution through one supernode for `labels` values a face: x_k = source_k + sum_i p_ki x_i, last pivot
/// first. `x` holds (pivots + rows) x labels, pivots with their source terms; seeds keep what they hold.
template <std::size_t labels, std::size_t longest>
RW_SEGMENTATION_ALWAYS_INLINE void substitute(const double* transition, std::size_t pivots, std::size_t rows,
                                              const std::uint32_t* absorbing, double* x) {
  const std::size_t size = pivots + rows;
  const double* p = transition + pivots * (pivots - 1) / 2 + pivots * rows;  // behind the last column
  for (std::size_t k = pivots; k-- > 0;) {
    const std::size_t length = size - k - 1;
    p -= length;
    prefetch_earlier(p);
    if (absorbing[k]) continue;
    const double* below = x + (k + 1) * labels;
    double* own = x + k * labels;
    if constexpr (labels == 1) {
      own[0] += dot_product(p, below, length);
      continue;
    }
#if defined(__GNUC__) || defined(__clang__)
    constexpr std::size_t vector_length = std::min(labels, longest), parts = labels / vector_length;
    constexpr std::size_t chains = std::min<std::size_t>(4, 8 / parts);  // one would wait for its own last sum
    using Vector __attribute__((vector_size(vector_length * sizeof(double)), aligned(8))) = double;
    Vector sum[parts][chains] = {};
    const auto add = [&](std::size_t i, std::size_t chain) {
      for (std::size_t part = 0; part < parts; ++part) {
        Vector value;
        std::memcpy(&value, below + i * labels + part * vector_length, sizeof value);
        sum[part][chain] += value * p[i];
      }
    };
    std::size_t i = 0;
    for (; i + chains <= length; i += chains) {
      prefetch_earlier(p + i + 8);
      for (std::size_t chain = 0; chain < chains; ++chain) add(i + chain, chain);
    }
    for (; i < length; ++i) add(i, 0);
    for (std::size_t part = 0; part < parts; ++part) {
      Vector total;
      std::memcpy(&total, own + part * vector_length, sizeof total);
      for (std::size_t chain = 0; chain < chains; ++chain) total += sum[part][chain];
      std::memcpy(own + part * vector_length, &total, sizeof total);
    }
#else
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t label = 0; label < labels; ++label) own[label] += p[i] * below[i * labels + label];
#endif
  }
}

/// Keeps the larger of two potentials and its rank, the earlier one on a tie, and adds to the total. Ranks are doubles so
/// that one comparison selects both in wide registers.
RW_SEGMENTATION_ALWAYS_INLINE void select_largest(const double* potential, double rank, std::size_t count,
                                                  double* largest, double* best, double* total) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool larger = potential[i] > largest[i];
    total[i] += potential[i];
    best[i] = larger ? rank : best[i];
    largest[i] = larger ? potential[i] : largest[i];
  }
}

RW_SEGMENTATION_ALWAYS_INLINE void subtract_multiple(double factor, const double* from, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const double left = to[i] - factor * from[i];
    to[i] = left > 0 ? left : 0;
  }
}

}  // namespace kernel

enum class Instruction_set { portable, avx2, avx512 };

inline Instruction_set best_instruction_set() {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  static const Instruction_set best = __builtin_cpu_supports("avx512f") ? Instruction_set::avx512
                                      : __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
                                          ? Instruction_set::avx2
                                          : Instruction_set::portable;
  return best;
#else
  return Instruction_set::portable;
#endif
}

#ifdef RW_SEGMENTATION_X86_DISPATCH
__attribute__((target("avx2,fma"))) inline void eliminate_avx2(const Front& front) { kernel::eliminate<4>(front); }
__attribute__((target("avx512f,fma"))) inline void eliminate_avx512(const Front& front) { kernel::eliminate<8>(front); }
__attribute__((target("avx2,fma"))) inline double* eliminate_block_avx2(const Front& front, std::size_t begin,
                                                                        std::size_t end, double* transition) {
  return kernel::eliminate_block(front, begin, end, transition);
}
__attribute__((target("avx512f,fma"))) inline double* eliminate_block_avx512(const Front& front, std::size_t begin,
                                                                             std::size_t end, double* transition) {
  return kernel::eliminate_block(front, begin, end, transition);
}
__attribute__((target("avx2,fma"))) inline void add_rows_avx2(const kernel::Outer_product& product,
                                                              const double* packed, std::size_t begin,
                                                              std::size_t end) {
  kernel::add_rows<4>(product, packed, begin, end);
}
__attribute__((target("avx512f,fma"))) inline void add_rows_avx512(const kernel::Outer_product& product,
                                                                   const double* packed, std::size_t begin,
                                                                   std::size_t end) {
  kernel::add_rows<8>(product, packed, begin, end);
}
__attribute__((target("avx2"))) inline void select_largest_avx2(const double* potential, double rank, std::size_t count,
                                                                double* largest, double* best, double* total) {
  kernel::select_largest(potential, rank, count, largest, best, total);
}
__attribute__((target("avx512f"))) inline void select_largest_avx512(const double* potential, double rank,
                                                                     std::size_t count, double* largest, double* best,
                                                                     double* total) {
  kernel::select_largest(potential, rank, count, largest, best, total);
}
__attribute__((target("avx2,fma"))) inline void subtract_multiple_avx2(double factor, const double* from,
                                                                       std::size_t count, double* to) {
  kernel::subtract_multiple(factor, from, count, to);
}
__attribute__((target("avx512f,fma"))) inline void subtract_multiple_avx512(double factor, const double* from,
                                                                            std::size_t count, double* to) {
  kernel::subtract_multiple(factor, from, count, to);
}
template <std::size_t labels>
__attribute__((target("avx2,fma"))) void substitute_avx2(const double* transition, std::size_t pivots, std::size_t rows,
                                                         const std::uint32_t* absorbing, double* x) {
  kernel::substitute<labels, 4>(transition, pivots, rows, absorbing, x);
}
template <std::size_t labels>
__attribute__((target("avx512f,fma"))) void substitute_avx512(const double* transition, std::size_t pivots,
                                                              std::size_t rows, const std::uint32_t* absorbing,
                                                              double* x) {
  kernel::substitute<labels, 8>(transition, pivots, rows, absorbing, x);
}
#endif

inline void eliminate(const Front& front, Instruction_set set) {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return eliminate_avx512(front);
  if (set == Instruction_set::avx2) return eliminate_avx2(front);
#endif
  static_cast<void>(set);
  kernel::eliminate<2>(front);
}

inline double* eliminate_block(const Front& front, std::size_t begin, std::size_t end, double* transition,
                               Instruction_set set) {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return eliminate_block_avx512(front, begin, end, transition);
  if (set == Instruction_set::avx2) return eliminate_block_avx2(front, begin, end, transition);
#endif
  static_cast<void>(set);
  return kernel::eliminate_block(front, begin, end, transition);
}

inline void add_rows(const kernel::Outer_product& product, const double* packed, std::size_t begin, std::size_t end,
                     Instruction_set set) {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return add_rows_avx512(product, packed, begin, end);
  if (set == Instruction_set::avx2) return add_rows_avx2(product, packed, begin, end);
#endif
  static_cast<void>(set);
  kernel::add_rows<2>(product, packed, begin, end);
}

/// As `eliminate`, with the same result; the products of a large front are shared among threads.
template <class ConcurrencyTag>
void eliminate_in_parallel(const Front& front, Instruction_set set) {
  constexpr std::size_t rows_per_task = 8 * 2 * kernel::longest_vector;
  const auto add = [&](const kernel::Outer_product& product) {
    if (is_small(product)) return kernel::add_small_product(product);
    kernel::pack_columns(product, front.packed);
    parallel_tasks<ConcurrencyTag>((product.rows + rows_per_task - 1) / rows_per_task, [&](std::size_t task) {
      const std::size_t begin = task * rows_per_task;
      add_rows(product, front.packed, begin, std::min(begin + rows_per_task, product.rows), set);
    });
  };
  double* transition = front.transition;
  for (std::size_t begin = 0; begin < front.pivots; begin += front_block) {
    const std::size_t end = std::min(front.pivots, begin + front_block);
    transition = eliminate_block(front, begin, end, transition, set);
    if (end < front.pivots) add(kernel::update_of_pivots(front, begin, end));
    if (front.rows > 0) add(kernel::update_of_rows(front, begin, end));
  }
}

/// By face, of the labels so far.
struct Largest_so_far {
  double *largest, *best, *total;
};

inline void select_largest(const double* potential, double rank, std::size_t count, const Largest_so_far& so_far,
                           Instruction_set set) {
  const auto [largest, best, total] = so_far;
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return select_largest_avx512(potential, rank, count, largest, best, total);
  if (set == Instruction_set::avx2) return select_largest_avx2(potential, rank, count, largest, best, total);
#endif
  static_cast<void>(set);
  kernel::select_largest(potential, rank, count, largest, best, total);
}

/// to -= factor * from, where both are potentials: what rounding makes negative becomes 0.
inline void subtract_multiple(double factor, const double* from, std::size_t count, double* to, Instruction_set set) {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return subtract_multiple_avx512(factor, from, count, to);
  if (set == Instruction_set::avx2) return subtract_multiple_avx2(factor, from, count, to);
#endif
  static_cast<void>(set);
  kernel::subtract_multiple(factor, from, count, to);
}

template <std::size_t labels>
void substitute(const double* transition, std::size_t pivots, std::size_t rows, const std::uint32_t* absorbing,
                double* x, Instruction_set set) {
#ifdef RW_SEGMENTATION_X86_DISPATCH
  if (set == Instruction_set::avx512) return substitute_avx512<labels>(transition, pivots, rows, absorbing, x);
  if (set == Instruction_set::avx2) return substitute_avx2<labels>(transition, pivots, rows, absorbing, x);
#endif
  static_cast<void>(set);
  kernel::substitute<labels, 2>(transition, pivots, rows, absorbing, x);
}

}  // namespace RW_segmentation::internal

#endif
