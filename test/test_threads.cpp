// Several threads at a time: objects of their own, one object that all of them read, and the library's own threads.
// Under ThreadSanitizer these tests also tell of data races.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/transfer_segments.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

#include <Eigen/Core>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <iterator>
#include <thread>
#include <vector>

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

TEST(Threads, OfTbbDoNotChangeTheSurfacesOfAMachinePart) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(12));
  expect_the_same_with_threads_of_tbb<Labels>([&] {
    Face_labels<Surface_mesh> labels(mesh);
    segmentation_into_surfaces(mesh, labels.map());
    return labels.values();
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

#ifdef CGAL_LINKED_WITH_TBB

namespace {

/// The points of a mesh, which tell how many threads there could be where they are asked for.
struct Observed_points {
  using key_type = Surface_mesh::Vertex_index;
  using value_type = Surface_mesh::Point;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;
  Surface_mesh* mesh;
  int* most_threads;
  friend value_type get(const Observed_points& map, key_type v) {
    *map.most_threads = std::max(*map.most_threads, tbb::this_task_arena::max_concurrency());
    return map.mesh->point(v);
  }
  friend void put(const Observed_points& map, key_type v, const value_type& point) { map.mesh->point(v) = point; }
};

}  // namespace

// Every function asks for points where it reads the mesh, which large ones do with several threads.
TEST(SequentialTag, KeepsEveryFunctionToTheCallingThread) {
  using One = CGAL::Sequential_tag;
  using Face = Surface_mesh::Face_index;
  Surface_mesh mesh = meshes::surface_mesh(two_spheres(16));
  int most_threads = 0;
  const auto np = CGAL::parameters::vertex_point_map(Observed_points{&mesh, &most_threads});
  const auto expect_one_thread = [&](const char* function, const auto& call) {
    most_threads = 0;
    call();
    EXPECT_EQ(most_threads, 1) << function;
  };

  const auto ids = mesh.add_property_map<Face, std::size_t>("f:id").first;
  const auto numbers = mesh.add_property_map<Face, double>("f:number").first;
  const auto normals = mesh.add_property_map<Face, Eigen::Vector3d>("f:normal").first;
  const auto curvatures = mesh.add_property_map<Face, Surface_curvatures>("f:curvatures").first;
  const Dihedral_difference difference(mesh);
  const auto conductance =
      as_conductance(boost::make_function_property_map<Surface_mesh::Edge_index>([&](Surface_mesh::Edge_index) {
        most_threads = std::max(most_threads, tbb::this_task_arena::max_concurrency());
        return 1.;
      }));
  const std::vector<Face> seeds = {Face(0), Face(100)};
  std::vector<Face> found;

  expect_one_thread("smoothed_shape", [&] { smoothed_shape<One>(mesh, np); });
  expect_one_thread("smoothed_face_normals", [&] { smoothed_face_normals<One>(mesh, normals, np); });
  expect_one_thread("integral_invariant_curvatures", [&] { integral_invariant_curvatures<One>(mesh, curvatures, np); });
  expect_one_thread("feature_sensitive_seeds", [&] {
    feature_sensitive_seeds<One>(mesh, 9, std::back_inserter(found), seeds, Farthest_point_sampling(), np);
  });
  expect_one_thread("feature_sensitive_seeds of normals",
                    [&] { feature_sensitive_seeds<One>(mesh, normals, 9, std::back_inserter(found), np); });
  expect_one_thread("coarse_seeds",
                    [&] { coarse_seeds<One>(mesh, difference, Seed_count_stop(9), std::back_inserter(found), np); });
  expect_one_thread("segmentation_from_seeds",
                    [&] { segmentation_from_seeds<Star_mesh_elimination, One>(mesh, conductance, seeds, ids); });
  expect_one_thread("fragments_via_random_walks",
                    [&] { fragments_via_random_walks<One>(mesh, conductance, seeds, ids, np); });
  expect_one_thread("local_thickness", [&] { local_thickness<One>(mesh, numbers, np); });
  expect_one_thread("thickness_of_all_faces", [&] { thickness_of_all_faces<One>(mesh, numbers, np); });
  expect_one_thread("transfer_segments", [&] { transfer_segments<One>(mesh, ids, mesh, conductance, ids, 2, np, np); });
  expect_one_thread("merge_segments", [&] { merge_segments<One>(mesh, ids, difference, np); });
  expect_one_thread("segmentation_into_surfaces", [&] { segmentation_into_surfaces<One>(mesh, ids, np); });
  expect_one_thread("hierarchy_via_random_walks", [&] { hierarchy_via_random_walks<One>(mesh, np); });
  expect_one_thread("segmentation_via_random_walks", [&] { segmentation_via_random_walks<One>(mesh, ids, np); });
  std::vector<Boundary_curve<Surface_mesh>> curves;
  expect_one_thread("smooth_boundaries", [&] { curves = smooth_boundaries<One>(mesh, ids, np); });
  expect_one_thread("split_along_boundaries", [&] { split_along_boundaries<One>(mesh, curves, ids, np); });
}

#endif
