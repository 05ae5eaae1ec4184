// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_RANDOM_WALK_H
#define RW_SEGMENTATION_RANDOM_WALK_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/Graph_walk.h>
#include <RW_segmentation/internal/walk/make_solver.h>
#include <RW_segmentation/internal/walk/read_conductances.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The random walk on the faces of a mesh, as an object: seeds are added and removed, and the segments asked for
/// again, at a fraction of the cost of the first answer (section 3 of the paper).
///
/// A walk at a face steps over an edge with a probability proportional to the edge's conductance (Eq. 1-2) and ends at
/// the first seed it meets. A face belongs to the label whose seeds it most probably meets first (Eq. 3), the lowest
/// one on a tie. Several seed faces may carry one label.
///
/// - Faces of a component that holds no seed (constrained edges cut components, too) become a segment of their own.
/// - From three labels on, the faces of a label need not be connected. Faces cut off from the seeds of their label go to
///   the neighbouring label with the largest potential along their border and are counted in `report()`;
///   `write_raw_labels()` has them as they were.
///
/// - Constrained edges are walls, over which no walk steps.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`; it must outlive the walk and keep its faces and edges
/// \tparam Solver a model of `WalkSolver`: `Star_mesh_elimination` (the default, exact for conductances that are 0 or at least
/// 1e-200 of the largest) or
/// `Eigen_walk_solver<S>`
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`; holds
/// for all that the object does
///
/// Cost: the first `segment()` orders and factorises (see the solver), unless `anticipate()` has done so, and holds
/// O(m + n) memory besides the factor for m faces and n seeds. The first answer after an edit keeps a column of 8 bytes a
/// face for each seed face; from then on an added seed costs one pass over the factor and one over the columns, a removed
/// seed one pass over the columns, a changed label nothing. An edit of more than 8 seed faces at once, or beyond 64 seed
/// faces (strokes), is solved directly and keeps no columns. Potentials after edits are right to 1e-9; where digits would
/// be lost the walk factorises anew by itself.
template <class FaceListGraph, class Solver = Star_mesh_elimination,
          class ConcurrencyTag = CGAL::Parallel_if_available_tag>
class Random_walk {
  static_assert(internal::is_walk_solver<Solver>,
                "The third argument of Random_walk is a solver, a model of WalkSolver such as Star_mesh_elimination or "
                "Eigen_walk_solver, or a sequence of named parameters.");

 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  /// What the user calls a segment.
  using Label = std::size_t;

  /// Reads the mesh and the conductances; solves nothing yet.
  ///
  /// \tparam Mesh `FaceListGraph`, or a `Dual_mesh_of` one, which is not read again
  /// \tparam ConductanceMap `Conductance`, or what `as_conductance()` makes of a map of one's own. Read once for each
  /// interior edge.
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh
  /// \param conductance how easily walks cross its edges
  /// \param solver solves the walk
  /// \param np
  /// - `callback`: `std::function<bool(double)>`, told the progress of a long solve; `false` ends it with `Cancelled`.
  /// - `edge_is_constrained_map` (default: no edge is): the walls.
  /// - `vertex_point_map` (default: that of the mesh): tells degenerate faces, see `report()`.
  /// \throws std::invalid_argument if a conductance is negative or not finite
  /// \throws std::length_error if the mesh has 2^32 - 1 faces or more
  template <class Mesh, class ConductanceMap, class NamedParameters = CGAL::parameters::Default_named_parameters>
  Random_walk(const Mesh& mesh, const ConductanceMap& conductance, Solver solver = Solver(),
              const NamedParameters& np = CGAL::parameters::default_values())
      : mesh_(with_threads([&] { return internal::dual_mesh_without_points(mesh, np); })),
        walk_(with_threads([&] {
          return internal::Graph_walk(mesh_.graph(), internal::read_conductances(mesh_, conductance),
                                      internal::Any_walk_solver(std::move(solver)), internal::progress_of(np));
        })),
        faces_at_start_(num_faces(mesh_.mesh())),
        edges_at_start_(num_edges(mesh_.mesh())),
        count_degenerate_faces_(degenerate_faces_of(mesh, np)) {
    static_assert(internal::has_conductances<ConductanceMap>,
                  "Random_walk needs conductances: Conductance(mesh, difference), or as_conductance(map) for values of "
                  "your own.");
    static_assert(internal::has_only_names_of_stages<NamedParameters>,
                  "Random_walk takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  }

  /// As above, with the default solver.
  template <class Mesh, class ConductanceMap, class T, class Tag, class Base>
  Random_walk(const Mesh& mesh, const ConductanceMap& conductance,
              const CGAL::Named_function_parameters<T, Tag, Base>& np)
      : Random_walk(mesh, conductance, Solver(), np) {}

  /// Whether it is a face of the mesh as it was when the walk was made.
  bool has_face(face_descriptor face) const { return mesh_.index(face) != mesh_.none; }

  /// Makes a face a seed, or gives a seed another label.
  /// \throws std::invalid_argument if it is not a face of the mesh
  void add_seed(face_descriptor face, Label label) { walk_.add_seed(index(face, "seed"), label); }

  /// Makes a face an ordinary one again.
  /// \returns whether it was a seed
  /// \throws std::invalid_argument if it is not a face of the mesh
  bool remove_seed(face_descriptor face) { return walk_.remove_seed(index(face, "seed")); }

  /// Makes all faces ordinary ones.
  void clear_seeds() { walk_.clear_seeds(); }

  /// The seeds and their labels in the order in which they were added.
  std::vector<std::pair<face_descriptor, Label>> seeds() const {
    std::vector<std::pair<face_descriptor, Label>> result;
    for (const auto& seed : walk_.seeds()) result.emplace_back(mesh_.face(seed.face), seed.label);
    return result;
  }

  /// The label of a face that is a seed.
  std::optional<Label> label_of_seed(face_descriptor face) const { return walk_.label_of_seed(index(face, "seed")); }

  /// Works ahead for the first answer of two labels, which takes much longer than those after it: orders the faces, and
  /// factorises for the seeds of the first label, if there are any. For programs whose user looks at the mesh meanwhile.
  /// Where there are two labels already it does nothing.
  /// \throws std::runtime_error if the solver fails
  /// \throws Cancelled if the callback ends the computation
  void anticipate() {
    with_threads([&] { walk_.anticipate(); });
  }

  /// Writes the label of each face: the user's own labels, and the next unused ones for components without a seed.
  ///
  /// \tparam SegmentIdMap a model of `WritablePropertyMap` with the face descriptor as key and an integer as value
  /// \returns the number of different labels written, 0 for a mesh without faces
  /// \throws std::invalid_argument if there is no seed, or a label is no value of the map
  /// \throws std::runtime_error if the mesh has changed since the walk was made, or the solver fails
  /// \throws Cancelled if the callback ends the computation
  /// Nothing is written when it throws.
  template <class SegmentIdMap>
  std::size_t segment(SegmentIdMap segment_ids) {
    check_faces();
    return write(*with_threads([&] { return &walk_.labels(); }), segment_ids);
  }

  /// As `segment()`, but leaves faces that are cut off from the seeds of their label where the walk puts them.
  template <class SegmentIdMap>
  std::size_t write_raw_labels(SegmentIdMap segment_ids) {
    check_faces();
    return write(with_threads([&] { return walk_.raw_labels(); }), segment_ids);
  }

  /// The probability that a walk from the face meets a seed of the label first; 0 for a label without seeds.
  ///
  /// The first call for a label after an edit solves for all faces and keeps the answer (8 bytes a face and label).
  /// \throws as `segment()`, and std::invalid_argument if it is not a face of the mesh; of a changed mesh it notices
  /// other numbers of faces or edges only
  double probability(face_descriptor face, Label label) {
    check_counts();
    return with_threads([&] { return walk_.potential(index(face, "face"), label); });
  }

  /// Writes the probability of a label for all faces.
  /// \tparam ProbabilityMap a model of `WritablePropertyMap` from the face descriptor to `double`
  /// \throws as `segment()`
  template <class ProbabilityMap>
  void write_probabilities(Label label, ProbabilityMap probabilities) {
    static_assert(internal::is_writable_map<ProbabilityMap, face_descriptor>,
                  "probabilities must be a writable property map from the mesh's face_descriptor to double.");
    check_faces();
    mesh_.write_faces(with_threads([&] { return walk_.potential(label); }), probabilities);
  }

  /// What the mesh has and the last answer met that is odd but not wrong. Looks at each face of the mesh.
  /// \throws std::invalid_argument if a coordinate is not finite
  Walk_report report() const {
    Walk_report report = walk_.report();
    report.degenerate_faces = with_threads([&] { return count_degenerate_faces_(); });
    return report;
  }

 private:
  template <class Work>
  static auto with_threads(const Work& work) {
    return internal::with_threads<ConcurrencyTag>(work);
  }

  template <class NamedParameters>
  static std::function<std::size_t()> degenerate_faces_of(const FaceListGraph& mesh, const NamedParameters& np) {
    const auto points =
        CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
                                           CGAL::get_const_property_map(CGAL::vertex_point, mesh));
    return [points, &mesh] {
      return Dual_mesh_of(mesh, CGAL::parameters::vertex_point_map(points)).number_of_degenerate_faces();
    };
  }
  template <class NamedParameters>
  static std::function<std::size_t()> degenerate_faces_of(const Dual_mesh_of<FaceListGraph>& mesh,
                                                          const NamedParameters&) {
    return [count = mesh.number_of_degenerate_faces()] { return count; };
  }

  /// \param role what the face is called in the error
  Dual_mesh::Index index(face_descriptor face, const char* role) const {
    if (!has_face(face)) throw std::invalid_argument(std::string("the ") + role + " is not a face of the mesh");
    return mesh_.index(face);
  }

  [[noreturn]] static void refuse_changed_mesh() {
    throw std::runtime_error("the mesh has changed since the walk was made");
  }

  void check_counts() const {
    if (num_faces(mesh_.mesh()) != faces_at_start_ || num_edges(mesh_.mesh()) != edges_at_start_) refuse_changed_mesh();
  }

  /// Compares the faces themselves, since some meshes go on counting those that have been removed.
  void check_faces() const {
    check_counts();
    std::size_t number = 0;
    for (const face_descriptor face : faces(mesh_.mesh())) {
      if (!has_face(face)) refuse_changed_mesh();
      ++number;
    }
    if (number != mesh_.number_of_faces()) refuse_changed_mesh();
  }

  template <class SegmentIdMap>
  std::size_t write(const std::vector<Label>& labels, SegmentIdMap segment_ids) const {
    static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                  "segment_ids must be a writable property map from the mesh's face_descriptor to an integer.");
    using Id = typename boost::property_traits<SegmentIdMap>::value_type;
    internal::require_ids_fit<SegmentIdMap>(labels);
    std::set<Label> distinct;  // counted first: what may run out of memory comes before the first label is written
    for (std::size_t f = 0; f < labels.size(); ++f)
      if (f == 0 || labels[f] != labels[f - 1]) distinct.insert(labels[f]);
    for (std::size_t f = 0; f < labels.size(); ++f)
      put(segment_ids, mesh_.face(static_cast<Dual_mesh::Index>(f)), static_cast<Id>(labels[f]));
    return distinct.size();
  }

  Dual_mesh_of<FaceListGraph> mesh_;  // its graph stays where the walk refers to it
  internal::Graph_walk walk_;
  std::size_t faces_at_start_, edges_at_start_;
  std::function<std::size_t()> count_degenerate_faces_;
};

/// The type of mesh, and the solver unless named parameters stand in its place.
template <class Mesh, class ConductanceMap, class Third = Star_mesh_elimination,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Random_walk(const Mesh&, const ConductanceMap&, const Third& = Third(), const NamedParameters& = NamedParameters())
    -> Random_walk<typename internal::Mesh_type<Mesh>::type,
                   std::conditional_t<internal::is_named_parameters<Third>, Star_mesh_elimination, Third>>;

namespace internal {

/// What labels are compared as: texts by what they say, not by the place where that is.
template <class Label>
using Compared_label =
    std::conditional_t<std::is_same_v<Label, const char*> || std::is_same_v<Label, char*>, std::string_view, Label>;

/// What a label is called in an error: a number can be told, an enumerator cannot.
template <class Label>
std::string name_of_label([[maybe_unused]] const Label& label) {
  if constexpr (std::is_arithmetic_v<Label>)
    return "label " + std::to_string(label);
  else
    return "a label";
}

}  // namespace internal

/// Segments a mesh by the walk from given seeds, once.
///
/// \tparam Solver a model of `WalkSolver`
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph, ConductanceMap, SegmentIdMap as for `Random_walk`
/// \tparam SeedRange a range of face descriptors, whose places are their labels, or of pairs of a face descriptor and a
/// label: a number, an enumerator, a string, whatever `<` orders; several faces may share a label
/// \param segment_ids output, contiguous ids from 0: the labels in ascending order, then the components without a seed.
/// It may be the map that the seeds were taken from.
/// \param np as for `Random_walk`
/// \returns the number of segments
/// \throws std::invalid_argument if there are no seeds, a seed is not a face of the mesh, or a face is given two labels
/// \throws std::runtime_error if the solver fails
/// \throws Cancelled
/// Nothing is written when it throws.
template <class Solver = Star_mesh_elimination, class ConcurrencyTag = CGAL::Parallel_if_available_tag,
          class FaceListGraph, class ConductanceMap, class SeedRange, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t segmentation_from_seeds(const FaceListGraph& mesh, const ConductanceMap& conductance,
                                    const SeedRange& seeds, SegmentIdMap segment_ids,
                                    const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(
      internal::has_conductances<ConductanceMap>,
      "segmentation_from_seeds() needs conductances: Conductance(mesh, difference), or as_conductance(map) for "
      "values of your own.");
  static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a writable property map from the mesh's face_descriptor to an integer.");
  const auto labelled_face = [](const auto& seed, std::size_t place) {
    if constexpr (std::is_convertible_v<decltype(seed), face_descriptor>)
      return std::pair<face_descriptor, std::size_t>(seed, place);
    else
      return std::pair<face_descriptor, internal::Compared_label<std::decay_t<decltype(seed.second)>>>(seed.first,
                                                                                                       seed.second);
  };
  using Labelled_face = decltype(labelled_face(*std::begin(seeds), 0));
  using Label = typename Labelled_face::second_type;
  std::vector<Labelled_face> labelled;
  for (const auto& seed : seeds) labelled.push_back(labelled_face(seed, labelled.size()));
  std::map<Label, std::size_t> id_of_label;
  for (const auto& seed : labelled) id_of_label.try_emplace(seed.second);
  std::size_t ids = 0;
  for (auto& entry : id_of_label) entry.second = ids++;

  Random_walk<typename internal::Mesh_type<FaceListGraph>::type, Solver, ConcurrencyTag> walk(mesh, conductance,
                                                                                              Solver(), np);
  for (std::size_t s = 0; s < labelled.size(); ++s) {
    const auto& [face, label] = labelled[s];
    if (!walk.has_face(face)) throw std::invalid_argument("seed " + std::to_string(s) + " is not a face of the mesh");
    if (const auto known = walk.label_of_seed(face); known && *known != id_of_label[label])
      throw std::invalid_argument("seed " + std::to_string(s) + " gives " + internal::name_of_label(label) +
                                  " to a face that an earlier seed gives another label");
    walk.add_seed(face, id_of_label[label]);
  }
  return walk.segment(segment_ids);
}

}  // namespace RW_segmentation

#endif
