// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_PRINCETON_DATA_H
#define RW_SEGMENTATION_BENCHMARK_PRINCETON_DATA_H

// The meshes of the Princeton Segmentation Benchmark and what people made of them, and changes of the meshes. The data
// are not part of this package; they lie in the benchmark's own layout: data/off/N.off and data/seg/Benchmark/N/N_k.seg.

#include "measurement.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace princeton {

using measurement::Mesh;
using Face = Mesh::Face_index;
using Labels = std::vector<std::size_t>;  // in the order of the faces

// ---- The benchmark's data ----

struct Subject {
  std::size_t number;         // 1 .. 400
  Mesh mesh;                  // as it is segmented
  std::vector<Face> nearest;  // face of `mesh` for each face that people labelled
  std::vector<Labels> people;
};

constexpr std::size_t meshes_of_a_category = 20;

/// What a mesh shows.
std::string category_of(std::size_t number);

/// The numbers of the meshes of the folder data/off, in growing order.
std::vector<std::size_t> numbers_in_folder(const std::filesystem::path& folder);

/// \throws std::runtime_error if there are none.
std::vector<std::size_t> numbers_in_file(const std::string& path);

// ---- Changes of the meshes that test robustness ----

struct Changes {
  double noise = 0;  // standard deviation of each coordinate, percent of the diagonal of the bounding box
  double faces = 1;  // factor: a power of 4, or less than 1
};

/// Of the bounding box.
double diagonal_of(const Mesh& mesh);

/// Ends an edge collapse at a fraction of the edges. CGAL's own predicate changed its name between versions.
struct Edge_ratio_stop {
  double ratio;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t initial, std::size_t current) const {
    return static_cast<double>(current) <= ratio * static_cast<double>(initial);
  }
};

/// \throws std::runtime_error if a file is missing or is not what it should be, std::invalid_argument for another factor
Subject read_subject(const std::filesystem::path& data, std::size_t number, const Changes& changes);

}  // namespace princeton

#endif
