// SPDX-License-Identifier: MIT

// CGAL's tag of concurrency holds for all that a function does.

#ifdef CGAL_LINKED_WITH_TBB

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>
#include <RW_segmentation/transfer_segments.h>

#include <tbb/task_arena.h>

#include <Eigen/Core>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "meshes.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

namespace test_sequential_tag {

using namespace RW_segmentation;
using meshes::Surface_mesh;

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
  Surface_mesh mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(3, 0.3, 16));
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
  expect_one_thread("segment_surfaces", [&] {
    segment_surfaces<One>(mesh, ids, merge_segments(mesh, ids, difference).number_of_fragments(), np);
  });
  expect_one_thread("segmentation_into_surfaces", [&] { segmentation_into_surfaces<One>(mesh, ids, np); });
  expect_one_thread("hierarchy_via_random_walks", [&] { hierarchy_via_random_walks<One>(mesh, np); });
  expect_one_thread("segmentation_via_random_walks", [&] { segmentation_via_random_walks<One>(mesh, ids, np); });
  std::vector<Boundary_curve<Surface_mesh>> curves;
  expect_one_thread("smooth_boundaries", [&] { curves = smooth_boundaries<One>(mesh, ids, np); });
  expect_one_thread("split_along_boundaries", [&] { split_along_boundaries<One>(mesh, curves, ids, np); });
}

// A walk asks for points when it is made and for its report, and tells its progress while it solves.
TEST(SequentialTag, KeepsAWalkToTheCallingThreadAsLongAsItLives) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(3, 0.3, 16));
  int most_threads = 0;
  const std::function<bool(double)> observe = [&](double) {
    most_threads = std::max(most_threads, tbb::this_task_arena::max_concurrency());
    return true;
  };
  const auto conductance = as_conductance(boost::make_function_property_map<Surface_mesh::Edge_index>(
      [&](Surface_mesh::Edge_index) { return observe(0) ? 1. : 0.; }));
  Random_walk<Surface_mesh, Star_mesh_elimination, CGAL::Sequential_tag> walk(
      mesh, conductance, Star_mesh_elimination(),
      CGAL::parameters::vertex_point_map(Observed_points{&mesh, &most_threads}).callback(observe));
  EXPECT_EQ(most_threads, 1);
  const auto ids = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:id").first;
  walk.add_seed(Surface_mesh::Face_index(0), 0);
  walk.add_seed(Surface_mesh::Face_index(100), 1);
  for (const auto& call : std::vector<std::function<void()>>{[&] { walk.segment(ids); }, [&] { walk.report(); },
                                                             [&] {
                                                               walk.add_seed(Surface_mesh::Face_index(50), 2);
                                                               walk.probability(Surface_mesh::Face_index(7), 2);
                                                             }}) {
    most_threads = 0;
    call();
    EXPECT_EQ(most_threads, 1);
  }
}

// Tiles are plain arrays, which nobody can watch: their steps are observed where they tell their progress.
TEST(SequentialTag, KeepsStepsOfTilesToTheCallingThread) {
  using One = CGAL::Sequential_tag;
  const Surface_mesh mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(3, 0.3, 16));
  const std::vector<Tile> tiles = {Tile_of(mesh)};
  const Tiled_segmentation options;
  int most_threads = 0;
  const Progress progress([&](double) {
    most_threads = std::max(most_threads, tbb::this_task_arena::max_concurrency());
    return true;
  });
  const auto observed = [&](const char* function, auto result) {
    EXPECT_EQ(most_threads, 1) << function;
    most_threads = 0;
    return result;
  };

  const Tile_plan plan = plan_tiles({survey_tile(tiles[0])});
  const Tile_in_plan place = {0, plan};
  Tile_noise noise;
  const Tile_border border = observed("border_of_tile", border_of_tile<One>(tiles[0], place, noise, options, progress));
  const Shaped_tile shaped =
      observed("shape_of_tile", shape_of_tile<One>(tiles[0], place, {}, noise_of_tiles({noise}), options, progress));
  const Tile_seeds seeds = seeds_of_tiles(plan, {shaped.outline});
  Tile_network network;
  const Tile_clusters clusters = clusters_of_tile<One>(shaped.shape, place, border, seeds, network);
  const std::vector<Tile_network> networks = {network};
  const Tile_walk walk = observed("walk_over_tiles", walk_over_tiles<One>(plan, seeds, networks, options, progress));
  Tile_regions regions;
  observed("fragments_of_tile",
           fragments_of_tile<One>({place, shaped.shape, clusters, {}, {}, seeds, walk}, regions, progress));
  observed("hierarchy_of_tiles", hierarchy_of_tiles<One>(tiles, options, progress));
  const std::vector<Seed_point> given = {{tiles[0].points.front(), 0}, {tiles[0].points.back(), 1}};
  observed("segments_of_tiles", segments_of_tiles<One>(tiles, given, options, progress));
}

}  // namespace test_sequential_tag

#endif
