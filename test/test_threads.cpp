// SPDX-License-Identifier: MIT

// Several threads at a time: objects of their own, one object that all of them read, and the library's own threads.
// Under ThreadSanitizer these tests also tell of data races.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/internal/mesh/Face_diffusion.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <boost/property_map/property_map.hpp>

#include <Eigen/Core>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace test_threads {

using namespace RW_segmentation;
using meshes::Surface_mesh;

namespace {

using Labels = std::vector<std::size_t>;

/// What `work` returns in each of several threads at the same time.
template <class Result>
std::vector<Result> in_threads(const std::function<Result()>& work) {
  std::vector<Result> results(4);
  std::vector<std::thread> threads;
  for (Result& result : results)
    threads.emplace_back([&] {
      try {
        result = work();
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    });
  for (std::thread& thread : threads) thread.join();
  return results;
}

/// Does the work in this thread, and then in several: the results must be the same.
template <class Result>
void expect_the_same_in_threads(const std::function<Result()>& work) {
  const Result expected = work();
  for (const Result& result : in_threads(work)) EXPECT_EQ(result, expected);
}

/// Does the work with one thread of TBB's and with several: the results must be the same.
template <class Result>
void expect_the_same_with_threads_of_tbb([[maybe_unused]] const std::function<Result()>& work) {
#ifdef CGAL_LINKED_WITH_TBB
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return work();
  };
  const Result expected = with(1);
  for (const std::size_t threads : {2U, 4U}) EXPECT_EQ(with(threads), expected) << threads;
#else
  GTEST_SKIP() << "TBB is not linked";
#endif
}

meshes::Shape two_spheres(std::size_t around) { return meshes::two_spheres_with_neck(3, 0.3, around); }

/// The segments that a policy finds.
template <class Policy>
Labels segments(const Surface_mesh& mesh, const Policy& policy) {
  Face_labels<Surface_mesh> labels(mesh);
  segmentation_via_random_walks(mesh, labels.map(), policy);
  return labels.values();
}

}  // namespace

TEST(Threads, EachMaySegmentAMeshOfItsOwn) {
  expect_the_same_in_threads<Labels>([] {
    const Surface_mesh mesh = meshes::surface_mesh(two_spheres(16));
    return segments(mesh, Automatic_segmentation());
  });
}

TEST(Threads, EachMayEditAWalkOfItsOwnOnOneMeshAndOneConductance) {
  const Surface_mesh mesh = meshes::surface_mesh(two_spheres(16));
  const Conductance conductance(mesh, Dihedral_difference(mesh));
  expect_the_same_in_threads<Labels>([&] {
    Random_walk walk(mesh, conductance);
    Face_labels<Surface_mesh> labels(mesh);
    walk.add_seed(labels.face(0), 0);
    walk.add_seed(labels.face(mesh.number_of_faces() - 1), 1);
    walk.segment(labels.map());
    walk.add_seed(labels.face(mesh.number_of_faces() / 2), 2);
    walk.segment(labels.map());
    return labels.values();
  });
}

TEST(Threads, AllMayReadLevelsOfOneHierarchy) {
  const Surface_mesh mesh = meshes::surface_mesh(two_spheres(16));
  const auto hierarchy = hierarchy_via_random_walks(mesh, Automatic_segmentation());
  expect_the_same_in_threads<Labels>([&] {
    Labels all;
    for (std::size_t level = 1; level <= hierarchy.number_of_fragments(); ++level) {
      Face_labels<Surface_mesh> labels(mesh);
      hierarchy.segments(Segment_count_stop(level), labels.map());
      all.insert(all.end(), labels.values().begin(), labels.values().end());
    }
    return all;
  });
}

// The meshes are large enough for work to be shared.
TEST(Threads, OfTbbDoNotChangeASegmentation) {
  const Surface_mesh mesh = meshes::surface_mesh(two_spheres(160));
  expect_the_same_with_threads_of_tbb<Labels>([&] { return segments(mesh, Automatic_segmentation()); });
}

TEST(Threads, OfTbbDoNotChangeAReducedSegmentation) {
  const Surface_mesh mesh = meshes::surface_mesh(two_spheres(160));
  Automatic_segmentation reduced;
  reduced.reduction.largest_direct = 0;
  expect_the_same_with_threads_of_tbb<Labels>([&] { return segments(mesh, reduced); });
}

/// Shapes beside each other, of several sizes.
meshes::Shape row_of(const std::vector<meshes::Shape>& shapes) {
  meshes::Shape row;
  double x = 0;
  for (const meshes::Shape& shape : shapes) row = meshes::together(row, meshes::moved(shape, {x += 20, 0, 0}));
  return row;
}

TEST(Threads, OfTbbDoNotChangeComponentsThatAreSegmentedAtTheSameTime) {
  const Surface_mesh mesh = meshes::surface_mesh(row_of(
      {two_spheres(12), two_spheres(40), meshes::l_shape(4), two_spheres(8), meshes::sphere(3), two_spheres(24)}));
  expect_the_same_with_threads_of_tbb<Labels>([&] { return segments(mesh, Automatic_segmentation()); });
}

TEST(Threads, OfTbbDoNotChangeTheSurfacesOfAnAssembly) {
  const Surface_mesh mesh = meshes::surface_mesh(
      row_of({meshes::l_shape(3), meshes::l_shape(8), meshes::cube(1), meshes::sphere(3), meshes::l_shape(6)}));
  expect_the_same_with_threads_of_tbb<Labels>([&] {
    Face_labels<Surface_mesh> labels(mesh);
    segmentation_into_surfaces(mesh, labels.map());
    return labels.values();
  });
}

TEST(Threads, OfTbbDoNotChangeTheSurfacesOfAMachinePart) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(12));
  expect_the_same_with_threads_of_tbb<Labels>([&] {
    Face_labels<Surface_mesh> labels(mesh);
    segmentation_into_surfaces(mesh, labels.map());
    return labels.values();
  });
}

TEST(Threads, OfTbbDoNotChangeNormalsThatAreSmoothedInStretches) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(4), 0.01));
  const Dual_mesh_of dual(mesh);
  const auto own = [&](Dual_mesh::Index f) { return dual.normal(f); };
  expect_the_same_with_threads_of_tbb<std::vector<Eigen::Vector3d>>([&] {
    constexpr std::size_t shortest_stretch = 200;
    internal::Face_diffusion diffusion(dual, 0.01 * dual.total_area(), shortest_stretch);
    return diffusion.solve(own, own, 1e-4, Progress());
  });
}

TEST(Threads, OfTbbDoNotChangeCurvatures) {
  const Surface_mesh mesh = meshes::surface_mesh(two_spheres(80));
  expect_the_same_with_threads_of_tbb<std::vector<double>>([&] {
    std::vector<Surface_curvatures> curvatures(mesh.number_of_faces());
    integral_invariant_curvatures(mesh,
                                  boost::make_iterator_property_map(curvatures.begin(), get(CGAL::face_index, mesh)),
                                  Ball_radius::absolute(0.2));
    std::vector<double> values;
    for (const Surface_curvatures& c : curvatures) values.insert(values.end(), {c.max_curvature, c.min_curvature});
    return values;
  });
}

}  // namespace test_threads
