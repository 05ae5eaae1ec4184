// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_CHOICES_H
#define RW_PYTHON_CHOICES_H

#include "../../examples/segment_mesh/Method.h"
#include "Mesh.h"

#include <RW_segmentation/Progress.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rw_python {

/// How segments are found, as the user says it. What is not given is left to the library's own numbers.
struct Choices {
  bool is_paper = false, is_coarse = false;
  std::optional<std::string> difference, components, seeding, merge_cost, solver, measure;
  std::optional<double> smoothing, convex_weight, radius, sigma, cap;
  std::optional<std::size_t> seeds, seedings, segments;
};

/// What the choices stand for, as the tool segment_mesh understands its options.
/// \param are_seeds_given whether each label of a seed of the user's becomes a segment
/// \throws std::invalid_argument if choices do not go together, or there is no such
segment_mesh::Method method_of(const Choices& choices, bool are_seeds_given);

/// The difference of a method, or values of the user's: a `Difference` of `Segmentation_policies`.
class Edge_difference {
 public:
  Edge_difference() = default;
  /// \param values by edge of the mesh; empty: those of the method
  Edge_difference(segment_mesh::Difference_function method, std::vector<double> values)
      : method_(std::move(method)), values_(std::move(values)) {}

  std::vector<double> operator()(const Dual& mesh, const RW_segmentation::Progress& progress) const;

 private:
  segment_mesh::Difference_function method_;
  std::vector<double> values_;
};

using Policies = decltype(segment_mesh::Policies().with_difference(Edge_difference()));

/// What the walk from given seeds goes by.
struct Walk_ground {
  Dual mesh;                       ///< with its own normals
  Dual shape;                      ///< with those of the shape
  std::vector<double> difference;  ///< by edge of the dual mesh; empty if conductances were given and nothing else asks
  std::vector<double> conductance;  ///< by edge of the mesh
};

/// The policies of a method, with a difference of the user's where there is one.
/// \param difference by edge of the mesh; empty: that of the method
Policies policies_of(const segment_mesh::Method& method, const std::vector<double>& difference);

/// The difference and the conductance of a method, or of the user's where they are given, by edge of the mesh; empty: not
/// given.
/// \param needs_difference also where the conductance is given
/// \throws std::invalid_argument, RW_segmentation::Cancelled
Walk_ground walk_ground(const Mesh& mesh, const Dual& dual, const Policies& policies,
                        const std::vector<double>& conductance, bool needs_difference,
                        const std::function<bool(double)>& callback);

}  // namespace rw_python

#endif
