// SPDX-License-Identifier: MIT

// What happens when memory runs out, the user cancels, or a map of the user's throws, at any moment.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/transfer_segments.h>

#include <boost/property_map/function_property_map.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <gtest/gtest.h>
#include <link.h>
#include "boundaries.h"
#include "face_labels.h"
#include "meshes.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

namespace {

#ifdef CGAL_LINKED_WITH_TBB
// Of several threads, which of them is refused memory would be chance.
const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
#endif

constexpr long never = std::numeric_limits<long>::max();
std::atomic<long> allocations_left = never;

/// Where code lies in memory.
struct Code {
  std::uintptr_t begin = 0, end = 0;
};

Code code_of_tbb() {
  Code code;
  dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t, void* found) {
        if (std::strstr(library->dlpi_name, "libtbb.") == nullptr) return 0;
        for (int i = 0; i < library->dlpi_phnum; ++i) {
          const auto& segment = library->dlpi_phdr[i];
          if ((segment.p_flags & PF_X) == 0) continue;
          const std::uintptr_t begin = library->dlpi_addr + segment.p_vaddr;
          *static_cast<Code*>(found) = {begin, begin + segment.p_memsz};
        }
        return 1;
      },
      &code);
  return code;
}

const Code tbb_code = code_of_tbb();

/// \param caller where operator new returns to. TBB hangs when its own allocations fail, so that they do not fail here.
void* allocate(std::size_t size, const void* caller) {
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  const bool is_of_tbb = tbb_code.begin <= address && address < tbb_code.end;
  if (allocations_left != never && !is_of_tbb && --allocations_left < 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Not inlined, where g++ would miss the operator new that an operator delete belongs to.
[[gnu::noinline]] void* operator new(std::size_t size) { return allocate(size, __builtin_return_address(0)); }
[[gnu::noinline]] void* operator new[](std::size_t size) { return allocate(size, __builtin_return_address(0)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size > 0 ? size : 1); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

using namespace RW_segmentation;
using meshes::Surface_mesh;

namespace {

using Callback = std::function<bool(double)>;

/// Makes the k-th allocation of `work` fail for each k until none does. Calls `check` after each failure.
void for_every_allocation(const std::function<void()>& work, const std::function<void()>& check) {
  long failures = 0;
  for (bool is_done = false; !is_done; ++failures) {
    ASSERT_LT(failures, 1000000);
    allocations_left = failures;
    try {
      work();
      is_done = true;
      allocations_left = never;
    } catch (const std::bad_alloc&) {
      allocations_left = never;
      check();
    }
  }
  EXPECT_GT(failures, 10);
}

/// Cancels `work(callback)` at its k-th call for each k until there is none. Calls `check` after each.
void for_every_call(const std::function<void(const Callback&)>& work, const std::function<void()>& check) {
  std::size_t cancelled = 0;
  for (bool is_done = false; !is_done; ++cancelled) {
    std::size_t calls = 0;
    try {
      work([&](double) { return calls++ != cancelled; });
      is_done = true;
    } catch (const Cancelled&) {
      EXPECT_EQ(calls, cancelled + 1) << "called after it had cancelled";
      check();
    }
  }
  EXPECT_GT(cancelled, 3u);
}

meshes::Shape two_spheres() { return meshes::two_spheres_with_neck(3, 0.3, 6); }

struct Faults : testing::Test {
#ifdef CGAL_LINKED_WITH_TBB
  void SetUp() override { ASSERT_LT(tbb_code.begin, tbb_code.end) << "where the code of TBB lies is not known"; }
#endif

  const Surface_mesh mesh = meshes::surface_mesh(two_spheres());
  Face_labels<Surface_mesh> labels{mesh};
  const std::vector<Surface_mesh::Face_index> seeds = {labels.face(0), labels.face(mesh.number_of_faces() - 1)};

  void expect_untouched() const {
    for (const std::size_t label : labels.values()) ASSERT_EQ(label, labels.untouched);
  }
};

}  // namespace

TEST_F(Faults, SegmentationThatRunsOutOfMemoryWritesNothing) {
  for_every_allocation([&] { segmentation_via_random_walks(mesh, labels.map()); }, [&] { expect_untouched(); });
}

TEST_F(Faults, ReducedSegmentationThatRunsOutOfMemoryWritesNothing) {
  Automatic_segmentation reduced;
  reduced.reduction.largest_direct = 0;
  for_every_allocation([&] { segmentation_via_random_walks(mesh, labels.map(), reduced); },
                       [&] { expect_untouched(); });
}

TEST_F(Faults, LabelsThatRunOutOfMemoryAreNotWritten) {
  const Conductance conductance(mesh, Dihedral_difference(mesh));
  Random_walk walk(mesh, conductance);
  for (std::size_t s = 0; s < 2; ++s) walk.add_seed(seeds[s], s);
  for_every_allocation([&] { walk.segment(labels.map()); }, [&] { expect_untouched(); });
}

TEST_F(Faults, TransferThatRunsOutOfMemoryWritesNothing) {
  const Surface_mesh half = meshes::surface_mesh(meshes::cube(2));
  Face_labels<Surface_mesh> sides(half);
  for (std::size_t f = 0; f < num_faces(half); ++f) put(sides.map(), sides.face(f), f % 3);
  const Conductance conductance(mesh, Dihedral_difference(mesh));
  for_every_allocation([&] { transfer_segments(half, sides.map(), mesh, conductance, labels.map()); },
                       [&] { expect_untouched(); });
}

TEST_F(Faults, EngineeringSegmentationThatRunsOutOfMemoryWritesNothing) {
  const Surface_mesh strip = meshes::surface_mesh(meshes::folded_strip(2));
  Face_labels<Surface_mesh> sides(strip), planes(strip);
  ASSERT_EQ(segmentation_into_surfaces(strip, planes.map()), 2U);
  for_every_allocation([&] { segmentation_into_surfaces(strip, sides.map()); },
                       [&] { ASSERT_EQ(sides.values()[0], sides.untouched); });
}

TEST_F(Faults, WalkThatRunsOutOfMemoryGoesOnLater) {
  const Conductance conductance(mesh, Dihedral_difference(mesh));
  Face_labels<Surface_mesh> expected(mesh), later(mesh);
  Random_walk whole(mesh, conductance);
  const auto edit = [&](auto& walk, const auto& map) {
    walk.add_seed(seeds[0], 0);
    walk.anticipate();
    walk.add_seed(seeds[1], 1);
    walk.segment(map);
    walk.add_seed(labels.face(40), 2);
    walk.segment(map);
    walk.remove_seed(labels.face(40));
    walk.segment(map);
  };
  edit(whole, expected.map());
  for (long failing = 0;; ++failing) {
    Random_walk walk(mesh, conductance);
    allocations_left = failing;
    try {
      edit(walk, labels.map());
      allocations_left = never;
      break;
    } catch (const std::bad_alloc&) {
      allocations_left = never;
    }
    edit(walk, later.map());
    ASSERT_EQ(later.values(), expected.values()) << "after the failure of allocation " << failing;
  }
}

TEST_F(Faults, BoundariesThatRunOutOfMemoryLeaveAValidMesh) {
  const auto cells = boundaries::random_cells(two_spheres(), 4);
  Surface_mesh cut;

  for_every_allocation(
      [&] {
        const long left = allocations_left;
        allocations_left = never;  // for the copy that is worked on
        cut = mesh;
        boundaries::Growing_face_labels<Surface_mesh> copied(cut, cells);
        allocations_left = left;
        const auto curves = smooth_boundaries(cut, copied.map());
        split_along_boundaries(cut, curves, copied.map());
      },
      [&] { ASSERT_TRUE(cut.is_valid(false)); });
}

TEST_F(Faults, CancellingAtAnyCallWritesNothing) {
  const auto with = [](const Callback& callback) { return CGAL::parameters::callback(callback); };
  const auto check = [&] { expect_untouched(); };
  const std::vector<Surface_mesh::Face_index> none;
  for_every_call(
      [&](const Callback& callback) {
        segmentation_via_random_walks(mesh, labels.map(), Automatic_segmentation(), none, with(callback));
      },
      check);
}

TEST_F(Faults, CancellingBoundariesAtAnyCallIsHeard) {
  const boundaries::Growing_face_labels<Surface_mesh> segments(mesh, boundaries::random_cells(two_spheres(), 4));
  auto copy = segments;
  for_every_call(
      [&](const Callback& callback) {
        smooth_boundaries(mesh, copy.map(), Boundary_smoothing(), CGAL::parameters::callback(callback));
      },
      [] {});
}

TEST_F(Faults, ExceptionOfAMapPassesThroughAndNothingIsWritten) {
  for (std::size_t reads = 0; reads < mesh.number_of_edges(); reads += 7) {
    std::size_t left = reads;
    const auto throwing = boost::make_function_property_map<Surface_mesh::Edge_index, double>([&](auto) {
      if (left-- == 0) throw std::domain_error("of the map");
      return 1.;
    });
    EXPECT_THROW(segmentation_from_seeds(mesh, as_conductance(throwing), seeds, labels.map()), std::domain_error);
    expect_untouched();
  }
}
