// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_STAR_MESH_ELIMINATION_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_STAR_MESH_ELIMINATION_H

#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/solver/Star_mesh_factor.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE Star_mesh_elimination::Star_mesh_elimination()
    : factor_(std::make_shared<internal::Star_mesh_factor>()) {}

RW_SEGMENTATION_INLINE void Star_mesh_elimination::analyze(const Dual_graph& graph) { factor_->analyze(graph); }

RW_SEGMENTATION_INLINE void Star_mesh_elimination::factorize(const std::vector<double>& conductances,
                                                             const std::vector<Index>& absorbing_faces,
                                                             const Progress& progress) {
  factor_->factorize(conductances, absorbing_faces, progress);
}

RW_SEGMENTATION_INLINE void Star_mesh_elimination::potentials(const Potentials& boundary_values,
                                                              Potentials& potentials) const {
  factor_->potentials(boundary_values, potentials);
}

RW_SEGMENTATION_INLINE void Star_mesh_elimination::response(Index face, const std::vector<double>& boundary_values,
                                                            std::vector<double>& column) const {
  factor_->response(face, boundary_values, column);
}

RW_SEGMENTATION_INLINE std::vector<double> Star_mesh_elimination::absorbed_currents(Index face) const {
  return factor_->absorbed_currents(face);
}

RW_SEGMENTATION_INLINE Largest_potentials Star_mesh_elimination::largest_potentials(const std::vector<Index>& labels,
                                                                                    std::size_t number_of_labels,
                                                                                    const Progress& progress) const {
  return factor_->largest_potentials(labels, number_of_labels, progress);
}

RW_SEGMENTATION_INLINE std::vector<std::vector<double>> Star_mesh_elimination::columns() const {
  return factor_->columns();
}

RW_SEGMENTATION_INLINE bool Star_mesh_elimination::has_unreached_faces() const {
  return factor_->has_unreached_faces();
}

RW_SEGMENTATION_INLINE std::size_t Star_mesh_elimination::factor_memory() const { return factor_->factor_memory(); }

}  // namespace RW_segmentation

#endif
