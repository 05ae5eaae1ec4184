// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_STAR_MESH_ELIMINATION_H
#define RW_SEGMENTATION_STAR_MESH_ELIMINATION_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {
class Star_mesh_factor;
}

/// Solves the walk by eliminating one face after another in the way electrical networks are reduced: the default
/// solver policy, a model of `WalkSolver`.
///
/// Eliminating face k with the conductances c_ki that are left replaces the star around k by a mesh among its
/// neighbours, c_ij += c_ik c_kj / d_k with d_k = sum_i c_ki. This is Gaussian elimination in the form of Grassmann,
/// Taksar and Heyman (1985) for Markov chains: d_k is a sum, never a diagonal entry less something, and nothing is ever
/// subtracted. Hence each potential is right to a small *relative* error whatever the range of the conductances (down
/// to 1e-200 of the largest), lies in [0, 1] by construction, and a face that no seed can reach is found exactly
/// (d_k = 0) instead of by a failing factorisation. Ordinary Cholesky has none of this: see the manual.
///
/// The elimination is multifrontal: approximate minimum degree ordering, once for a mesh; supernodes; dense fronts.
/// Where TBB is linked (`CGAL_LINKED_WITH_TBB`), subtrees of the elimination tree and the rows of the large fronts above
/// them are shared among threads, with the same result for any number of them.
///
/// Complexity on surface meshes with m faces, as measured: O(m^1.3) time to factorise, O(m log m) memory (about
/// 450 bytes a face at 640 000 faces), O(m log m) time for each block of 8 labels, or about as much for the largest
/// potentials of 40. Not safe to use from several threads at once.
class Star_mesh_elimination {
 public:
  /// Numbers faces and edges.
  using Index = Dual_graph::Index;

  /// Has analysed nothing yet.
  Star_mesh_elimination();
  /// Takes another solver with all that it has computed.
  Star_mesh_elimination(Star_mesh_elimination&&) = default;
  /// Takes another solver with all that it has computed.
  Star_mesh_elimination& operator=(Star_mesh_elimination&&) = default;
  /// A copy is a fresh solver: it has analysed nothing.
  Star_mesh_elimination(const Star_mesh_elimination&) : Star_mesh_elimination() {}
  /// Becomes a fresh solver.
  Star_mesh_elimination& operator=(const Star_mesh_elimination& other) {
    Star_mesh_elimination fresh(other);
    return *this = std::move(fresh);
  }

  /// Orders the elimination. Depends on the mesh only.
  /// \throws std::length_error for more faces than the ordering can number (about 2.5e8)
  void analyze(const Dual_graph& graph);

  /// Eliminates all faces that do not absorb.
  ///
  /// \param conductances of each edge of the graph, finite and >= 0; 0 cuts the edge
  /// \param absorbing_faces where walks end, all different
  /// \throws std::invalid_argument if the sizes differ from the analysed graph's
  /// \throws Cancelled
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing_faces,
                 const Progress& progress = {});

  /// The potentials of all faces for boundary values on the absorbing faces; a face that reaches no absorbing face gets
  /// 0 in every column.
  ///
  /// \param boundary_values one row an absorbing face, in the order given to `factorize`, one column a label
  /// \param potentials output, one row a face, as many columns
  void potentials(const Potentials& boundary_values, Potentials& potentials) const;

  /// The potentials when a unit current enters at `face` and the absorbing faces are held at given values: a column of
  /// Green's function, and more. Costs one pass over the factor.
  ///
  /// \param boundary_values one number an absorbing face, in the order given to `factorize`
  /// \param column output, one number a face
  /// \throws std::invalid_argument if the face absorbs or no walk from it is absorbed
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const;

  /// The share of a unit current entering at `face` that leaves at each absorbing face, all at 0: the probability that a
  /// walk from `face` ends there. Touches only the part of the factor between these faces and the root of the tree.
  ///
  /// \returns one number an absorbing face, in the order given to `factorize`
  /// \throws as `response`
  std::vector<double> absorbed_currents(Index face) const;

  /// The label with the largest potential at each face, the lowest one on a tie, without the potentials of the others:
  /// the maximum principle tells for most parts of a mesh that one label alone can win there. Takes a quarter of the time
  /// of `potentials` or less, and no memory for the potentials. In those parts that of the label is not computed, either.
  ///
  /// \param labels by absorbing face, in the order given to `factorize`: from 0 to `number_of_labels` - 1
  /// \returns by face; any label where no absorbing face can be reached
  /// \throws std::invalid_argument if there are not as many labels as absorbing faces
  /// \throws Cancelled
  Largest_potentials largest_potentials(const std::vector<Index>& labels, std::size_t number_of_labels,
                                        const Progress& progress = {}) const;

  /// The potentials when one absorbing face is held at 1 and the others at 0, for each of them in turn, from one pass over
  /// the factor: what `potentials` finds for the identity, column by column, in less time and memory.
  ///
  /// \returns by absorbing face, in the order given to `factorize`, then by face
  /// \throws std::invalid_argument before the first factorisation
  std::vector<std::vector<double>> columns() const;

  /// Faces from which no absorbing face can be reached were met in the last factorisation.
  bool has_unreached_faces() const;

  /// Bytes held by the factor.
  std::size_t factor_memory() const;

 private:
  std::shared_ptr<internal::Star_mesh_factor> factor_;  // of this solver alone
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Star_mesh_elimination.h>
#endif

#endif
