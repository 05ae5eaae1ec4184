// SPDX-License-Identifier: MIT

#include "Choices.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Random_walk.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace rw_python {
namespace {

/// The random walk on a mesh, with the difference by the choices or conductances of the user's.
class Walk {
 public:
  Walk(nb::object mesh, const Choices& choices, const std::optional<Numbers>& difference,
       const std::optional<Numbers>& conductance, const std::optional<Pairs>& walls, const nb::object& progress)
      : mesh_object_(std::move(mesh)), mesh_(nb::cast<const Mesh&>(mesh_object_)) {
    walk_ = without_lock(progress, [&](const auto& callback) {
      const segment_mesh::Method method = method_of(choices, !choices.is_coarse);
      const Dual dual = mesh_.dual(walls);
      const auto by_edge = [&](const auto& values, const char* argument) {
        return values ? mesh_.by_edge(*values, argument) : std::vector<double>();
      };
      return made(method, choices.is_coarse, dual, by_edge(difference, "the difference"),
                  by_edge(conductance, "the conductance"), callback);
    });
  }

  // The walk's callback refers to this.
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  /// All of them or none.
  void add_seeds(const std::vector<std::int64_t>& faces, std::int64_t label) {
    if (label < 0) throw std::invalid_argument("the label is " + std::to_string(label) + ", but must not be negative");
    std::vector<Face> seeds;
    for (const std::int64_t face : faces) seeds.push_back(mesh_.face(face, "seed"));
    const Access access(*this);
    for (const Face seed : seeds) walk_->add_seed(seed, static_cast<std::size_t>(label));
  }
  bool remove_seed(std::int64_t face) {
    const Access access(*this);
    return walk_->remove_seed(mesh_.face(face, "seed"));
  }
  void clear_seeds() {
    const Access access(*this);
    walk_->clear_seeds();
  }

  void anticipate(const nb::object& progress) {
    without_lock(progress, [&](const auto& callback) {
      const Access access(*this, &callback);
      walk_->anticipate();
      return true;  // since `without_lock()` returns what its work does
    });
  }

  /// Faces and their labels.
  std::vector<std::pair<std::int64_t, std::int64_t>> seeds() {
    const Access access(*this);
    const std::vector<std::int64_t> user_face = mesh_.user_faces();
    std::vector<std::pair<std::int64_t, std::int64_t>> result;
    for (const auto& [face, label] : walk_->seeds())
      result.emplace_back(user_face.empty() ? face.idx() : user_face[face.idx()], label);
    return result;
  }

  Array<std::int64_t> labels(const nb::object& progress) {
    return array_of(without_lock(progress, [&](const auto& callback) {
      const Access access(*this, &callback);
      std::vector<std::int64_t> label(num_faces(mesh_.halfedges()));
      walk_->segment(map_over<Face>(label));
      return mesh_.by_user_face<std::int64_t>(label);
    }));
  }

  /// \returns the labels of the seeds in ascending order, and a column for each of them
  nb::tuple probabilities(const nb::object& progress) {
    std::vector<std::int64_t> values;
    std::size_t columns = 0;
    std::vector<double> table = without_lock(progress, [&](const auto& callback) {
      const Access access(*this, &callback);
      std::set<std::size_t> labels;
      for (const auto& seed : walk_->seeds()) labels.insert(seed.second);
      values.assign(labels.begin(), labels.end());
      columns = labels.size();
      std::vector<double> rows(num_faces(mesh_.halfedges()) * columns);
      std::size_t k = 0;
      for (const std::size_t label : labels) walk_->write_probabilities(label, Column{rows.data() + k++, columns});
      return mesh_.by_user_face<double>(rows, columns);
    });
    return nb::make_tuple(array_of(std::move(values)), table_of(std::move(table), columns, mesh_.number_of_faces()));
  }

  nb::dict report() {
    const auto known = [this] {
      const Access access(*this);
      return walk_->report();
    }();
    nb::dict result;
    result["unseeded_components"] = known.unseeded_components;
    result["island_faces"] = known.island_faces;
    result["degenerate_faces"] = known.degenerate_faces;
    return result;
  }

 private:
  using Random_walk = RW::Random_walk<Array_mesh, segment_mesh::Chosen_solver>;

  /// A column of a table with a row a face, a property map.
  struct Column {
    using key_type = Face;
    using value_type = double;
    using reference = double&;
    using category = boost::writable_property_map_tag;
    double* first;
    std::size_t columns;
    friend void put(const Column& column, Face f, double value) { column.first[f.idx() * column.columns] = value; }
  };

  /// One thread after the other works with the walk; no other thread of Python waits for it.
  class Access {
   public:
    /// \param callback of a call without Python's lock; without one the calling thread holds that
    /// \throws std::runtime_error if the progress function of a call calls the walk
    explicit Access(Walk& walk, const std::function<bool(double)>* callback = nullptr) : walk_(walk) {
      if (walk_.user_ == std::this_thread::get_id())
        throw std::runtime_error("a walk cannot be used by the progress function of its own call");
      if (callback) {
        walk_.mutex_.lock();
      } else {
        const nb::gil_scoped_release release;
        walk_.mutex_.lock();
      }
      walk_.user_ = std::this_thread::get_id();
      walk_.callback_ = callback;
    }
    ~Access() {
      walk_.callback_ = nullptr;
      walk_.user_ = std::thread::id();
      walk_.mutex_.unlock();
    }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;

   private:
    Walk& walk_;
  };

  std::unique_ptr<Random_walk> made(const segment_mesh::Method& method, bool places_seeds, const Dual& dual,
                                    const std::vector<double>& difference, const std::vector<double>& conductance,
                                    const std::function<bool(double)>& callback) {
    const Policies policies = policies_of(method, difference);
    Walk_ground ground = walk_ground(mesh_, dual, policies, conductance, places_seeds, part(callback, 0, 0.8));
    // Refers to this alone: each call has a callback of its own.
    const auto of_call = CGAL::parameters::callback(
        std::function<bool(double)>([this](double fraction) { return !callback_ || (*callback_)(fraction); }));
    auto walk = std::make_unique<Random_walk>(dual, RW::as_conductance(map_over<Edge>(ground.conductance)),
                                              policies.solver, of_call);
    if (!places_seeds) return walk;
    std::size_t label = 0;
    for (const auto face : policies.seeding(ground.shape, ground.difference, {}, RW::Progress(part(callback, 0.8, 1))))
      walk->add_seed(dual.face(face), label++);
    return walk;
  }

  nb::object mesh_object_;
  const Mesh& mesh_;
  std::unique_ptr<Random_walk> walk_;
  std::mutex mutex_;
  std::atomic<std::thread::id> user_{};
  const std::function<bool(double)>* callback_ = nullptr;
};

}  // namespace

void define_walk(nb::module_& m) {
  nb::class_<Walk>(m, "Walk", "The random walk on a mesh.")
      .def(nb::init<nb::object, const Choices&, const std::optional<Numbers>&, const std::optional<Numbers>&,
                    const std::optional<Pairs>&, const nb::object&>(),
           nb::arg("mesh"), nb::arg("choices"), nb::arg("difference").none(), nb::arg("conductance").none(),
           nb::arg("walls").none(), nb::arg("progress").none())
      .def("add_seeds", &Walk::add_seeds, nb::arg("faces"), nb::arg("label"))
      .def("remove_seed", &Walk::remove_seed, nb::arg("face"))
      .def("clear_seeds", &Walk::clear_seeds)
      .def("anticipate", &Walk::anticipate, nb::arg("progress").none())
      .def("seeds", &Walk::seeds)
      .def("labels", &Walk::labels, nb::arg("progress").none())
      .def("probabilities", &Walk::probabilities, nb::arg("progress").none(),
           nb::sig("def probabilities(self, progress: object | None) -> tuple[numpy.typing.NDArray[numpy.int64], "
                   "numpy.typing.NDArray[numpy.float64]]"))
      .def("report", &Walk::report, nb::sig("def report(self) -> dict[str, int]"));
}

}  // namespace rw_python
