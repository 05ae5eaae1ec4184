// SPDX-License-Identifier: MIT

// Constrained edges are walls: where they close round a part of a mesh, no segment lies on both sides, whatever the
// policies. Walls here are the borders of random connected sets of faces.

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/property_map/function_property_map.hpp>

#include <cstddef>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_walls {

using namespace RW_segmentation;

namespace {

/// Walls on a mesh, and the parts that they cut it into.
template <class Mesh>
class Walls {
 public:
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;

  /// Walls round so many random connected sets of faces, which may overlap.
  Walls(const Mesh& mesh, unsigned chance, std::size_t patches = 2)
      : mesh_(mesh),
        side_(mesh, std::vector<std::size_t>(num_faces_of(mesh), 0)),
        part_(mesh, std::vector<std::size_t>(num_faces_of(mesh), none)),
        random_(chance) {
    for (std::size_t patch = 0; patch < patches; ++patch) add_patch(std::size_t(1) << patch);
    for (const face_descriptor f : faces(mesh_))
      if (get(part_.map(), f) == none) fill(f, parts_++);
  }

  /// Whether an edge is a wall.
  auto map() const {
    const auto side = side_.map();
    return boost::make_function_property_map<edge_descriptor>([this, side](const edge_descriptor& e) -> bool {
      const auto h = halfedge(e, mesh_), o = opposite(h, mesh_);
      if (CGAL::is_border(h, mesh_) || CGAL::is_border(o, mesh_)) return false;
      return get(side, face(h, mesh_)) != get(side, face(o, mesh_));
    });
  }

  std::size_t parts() const { return parts_; }
  /// By face, in the order of the mesh.
  const std::vector<std::size_t>& part() const { return part_.values(); }
  std::size_t part_of(face_descriptor f) const { return get(part_.map(), f); }
  face_descriptor random_face() { return side_.face(random_() % part().size()); }

 private:
  static constexpr std::size_t none = std::size_t(-1);

  static std::size_t num_faces_of(const Mesh& mesh) {
    return static_cast<std::size_t>(std::distance(faces(mesh).begin(), faces(mesh).end()));
  }

  std::vector<face_descriptor> neighbours(face_descriptor f) const {
    std::vector<face_descriptor> result;
    for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh_), mesh_))
      if (!CGAL::is_border(opposite(h, mesh_), mesh_)) result.push_back(face(opposite(h, mesh_), mesh_));
    return result;
  }

  /// Grows a connected set of faces, round or with arms.
  void add_patch(std::size_t bit) {
    const std::size_t size = 1 + random_() % (part().size() * 2 / 3);
    const bool is_round = random_() % 2 == 0;
    std::deque<face_descriptor> open = {random_face()};
    for (std::size_t taken = 0; taken < size && !open.empty();) {
      const auto next = open.begin() + static_cast<std::ptrdiff_t>(is_round ? 0 : random_() % open.size());
      const face_descriptor f = *next;
      open.erase(next);
      const std::size_t side = get(side_.map(), f);
      if (side & bit) continue;
      put(side_.map(), f, side | bit);
      ++taken;
      for (const face_descriptor g : neighbours(f)) open.push_back(g);
    }
  }

  void fill(face_descriptor first, std::size_t part) {
    std::vector<face_descriptor> open = {first};
    while (!open.empty()) {
      const face_descriptor f = open.back();
      open.pop_back();
      if (get(part_.map(), f) != none) continue;
      put(part_.map(), f, part);
      for (const face_descriptor g : neighbours(f))
        if (get(side_.map(), f) == get(side_.map(), g)) open.push_back(g);
    }
  }

  const Mesh& mesh_;
  mutable Face_labels<Mesh> side_;  // which of the patches a face belongs to, by bits
  mutable Face_labels<Mesh> part_;
  std::size_t parts_ = 0;
  std::mt19937 random_;
};

using Mesh = meshes::Surface_mesh;
using Index = Dual_mesh::Index;

/// How many faces lie in another part than the first face of their segment.
template <class M>
std::size_t faces_across(const Walls<M>& walls, const std::vector<std::size_t>& ids) {
  std::map<std::size_t, std::size_t> part_of_segment;
  std::size_t across = 0;
  for (std::size_t f = 0; f < ids.size(); ++f)
    across += part_of_segment.emplace(ids[f], walls.part()[f]).first->second != walls.part()[f];
  return across;
}

std::size_t number_of(const std::vector<std::size_t>& ids) {
  return std::set<std::size_t>(ids.begin(), ids.end()).size();
}

/// No level of a hierarchy has a segment on both sides, and the last one has a segment for each part. Levels are nested,
/// so that the last one speaks for all.
template <class M>
void expect_behind_walls(const Segment_hierarchy<M>& hierarchy, const M& mesh, const Walls<M>& walls) {
  ASSERT_EQ(hierarchy.number_of_components(), walls.parts());
  Face_labels<M> ids(mesh);
  EXPECT_EQ(hierarchy.segments(Segment_count_stop(walls.parts()), ids.map()), walls.parts());
  EXPECT_EQ(faces_across(walls, ids.values()), 0u);
  EXPECT_EQ(number_of(ids.values()), walls.parts());
  EXPECT_THROW(hierarchy.segments(Segment_count_stop(walls.parts() - 1), ids.map()), std::invalid_argument);
}

template <class M, class Policies, class Seeds = std::vector<typename Walls<M>::face_descriptor>>
void expect_walls_hold(const M& mesh, const Walls<M>& walls, const Policies& policies, const Seeds& given = {}) {
  const auto np = CGAL::parameters::edge_is_constrained_map(walls.map());
  const auto hierarchy = hierarchy_via_random_walks(mesh, policies, given, np);
  EXPECT_EQ(hierarchy.report().components, walls.parts());
  expect_behind_walls(hierarchy, mesh, walls);
  Face_labels<M> ids(mesh);
  const std::size_t segments = hierarchy.segments(policies.stop, ids.map());
  EXPECT_EQ(number_of(ids.values()), segments);
  EXPECT_EQ(faces_across(walls, ids.values()), 0u);
}

/// A cost that would join anything at once.
struct No_cost {
  struct Region {};
  Region region(const Dual_mesh&, Index) const { return {}; }
  void join(Region&, const Region&) const {}
  double operator()(const Region&, const Region&, const Region_boundary&) const { return 0; }
};

std::vector<meshes::Shape> closed_shapes() {
  return {meshes::sphere(2), meshes::torus(1, 0.4, 24, 12), meshes::two_spheres_with_neck(2.4, 0.3, 20),
          meshes::l_shape(4), meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, 24), 0.05)};
}

/// Calls `test(mesh, walls)` for closed meshes with random closed loops of walls.
template <class Test>
void on_walled_meshes(const Test& test, unsigned chances = 4) {
  for (const meshes::Shape& shape : closed_shapes()) {
    const Mesh mesh = meshes::surface_mesh(shape);
    for (unsigned chance = 1; chance <= chances; ++chance) {
      SCOPED_TRACE(testing::Message() << shape.faces.size() << " faces, walls " << chance);
      Walls<Mesh> walls(mesh, chance, 1 + chance % 3);
      test(mesh, walls);
    }
  }
}

}  // namespace

template <class Holder>
class EveryMesh : public testing::Test {};
TYPED_TEST_SUITE(EveryMesh, meshes::Holders);

TYPED_TEST(EveryMesh, HasNoSegmentOnBothSidesOfAWall) {
  for (const meshes::Shape& shape : {meshes::two_spheres_with_neck(2.4, 0.3, 16), meshes::cube_of_quads()}) {
    const TypeParam held(shape);
    for (unsigned chance = 1; chance <= 4; ++chance) {
      const Walls<typename TypeParam::Mesh> walls(held.mesh, chance);
      expect_walls_hold(held.mesh, walls, Automatic_segmentation());
    }
  }
}

// ---- The one call ----

TEST(WallsInOneCall, HoldForTheAutomaticPolicies) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    expect_walls_hold(mesh, walls, Automatic_segmentation());
    Face_labels<Mesh> ids(mesh);
    EXPECT_GE(segmentation_via_random_walks(mesh, ids.map(), CGAL::parameters::edge_is_constrained_map(walls.map())),
              walls.parts());
    EXPECT_EQ(faces_across(walls, ids.values()), 0u);
  });
}

TEST(WallsInOneCall, HoldHoweverFarNormalsAreSmoothed) {
  on_walled_meshes(
      [](const Mesh& mesh, Walls<Mesh>& walls) {
        Automatic_segmentation policies;
        for (const double radius : {0., 0.05, 1.}) {
          policies.smoothing.radius = radius;
          policies.smoothing.heavy_noise = radius > 0.5 ? 1e-3 : 2.5;  // moves the vertices, too
          expect_walls_hold(mesh, walls, policies);
        }
      },
      2);
}

TEST(WallsInOneCall, HoldForAWalkOverClusters) {
  on_walled_meshes(
      [](const Mesh& mesh, Walls<Mesh>& walls) {
        Automatic_segmentation policies;
        policies.reduction.largest_direct = 0;
        for (const std::size_t seeds : {1u, 8u, 40u}) {
          policies.seeding.count = seeds;
          for (const std::size_t band : {0u, 1u, 2u}) {
            policies.reduction.band = band;
            expect_walls_hold(mesh, walls, policies);
          }
        }
      },
      3);
}

TEST(WallsInOneCall, HoldForGivenSeeds) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    Automatic_segmentation policies;
    policies.seeding.count = 3;
    for (const std::size_t largest_direct : {std::size_t(0), std::size_t(1000000)}) {
      policies.reduction.largest_direct = largest_direct;
      expect_walls_hold(mesh, walls, policies, std::vector{walls.random_face(), walls.random_face()});
    }
  });
}

TEST(WallsInOneCall, HoldForThePapersPolicies) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) { expect_walls_hold(mesh, walls, Paper_segmentation()); });
}

TEST(WallsInOneCall, HoldForThePapersCoarsePolicies) {
  on_walled_meshes(
      [](const Mesh& mesh, Walls<Mesh>& walls) { expect_walls_hold(mesh, walls, Coarse_paper_segmentation()); });
}

TEST(WallsInOneCall, HoldForEverySeedingAndDifference) {
  using Seeding =
      std::function<std::vector<Index>(const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&)>;
  using Difference = std::function<std::vector<double>(const Dual_mesh&)>;
  const Seeding one_part = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
    return std::vector<Index>{0, 1, 2, 3};
  };
  const std::vector<Seeding> seedings = {Feature_sensitive_seeding<Farthest_point_sampling>{3, {}},
                                         Feature_sensitive_seeding<Particle_sampling>{25, {}},
                                         Coarse_seeding<>{Separation_threshold_stop()}, one_part};
  const std::vector<Difference> differences = {Dihedral_difference_policy(), Curvature_difference_policy()};
  on_walled_meshes(
      [&](const Mesh& mesh, Walls<Mesh>& walls) {
        for (const Difference& difference : differences) {
          const Difference measured_once = [values = difference(Dual_mesh_of(mesh))](const Dual_mesh&) {
            return values;
          };
          for (std::size_t i = 0; i < seedings.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "seeding " << i);
            auto policies = Automatic_segmentation().with_seeding(seedings[i]).with_difference(measured_once);
            policies.merge_cost.thickness.samples = 0;
            expect_walls_hold(mesh, walls, policies);
            policies.reduction.largest_direct = 0;
            expect_walls_hold(mesh, walls, policies);
          }
        }
      },
      2);
}

TEST(WallsInOneCall, HoldForEveryMergeCost) {
  on_walled_meshes(
      [](const Mesh& mesh, Walls<Mesh>& walls) {
        const auto expect_walls_hold_by = [&](const auto& cost) {
          expect_walls_hold(mesh, walls, Automatic_segmentation().with_merge_cost(cost));
        };
        expect_walls_hold_by(Size_aware_cost_policy());
        expect_walls_hold_by(Relative_boundary_cost());
        expect_walls_hold_by([](const Dual_mesh& shape) { return Analytic_surface_cost(shape); });
        expect_walls_hold_by(No_cost());
      },
      2);
}

TEST(WallsInOneCall, HoldForAnotherSolver) {
  on_walled_meshes(
      [](const Mesh& mesh, Walls<Mesh>& walls) {
        auto policies = Automatic_segmentation().with_solver(Eigen_walk_solver<>()).with_merge_cost(No_cost());
        policies.cap = 10;  // within what Eigen's factorisation vouches for
        for (const std::size_t largest_direct : {std::size_t(0), std::size_t(1000000)}) {
          policies.reduction.largest_direct = largest_direct;
          expect_walls_hold(mesh, walls, policies);
        }
      },
      3);
}

// ---- Stage by stage ----

TEST(WallsInStages, BoundFragments) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    const auto np = CGAL::parameters::edge_is_constrained_map(walls.map());
    const Conductance conductance(mesh, Dihedral_difference(mesh));
    const std::vector seeds = {walls.random_face(), walls.random_face(), walls.random_face()};
    for (const std::size_t largest_direct : {std::size_t(0), std::size_t(1000000)}) {
      Walk_reduction reduction;
      reduction.largest_direct = largest_direct;
      Face_labels<Mesh> ids(mesh);
      EXPECT_GE(fragments_via_random_walks(mesh, conductance, seeds, ids.map(), reduction, Star_mesh_elimination(), np),
                walls.parts());
      EXPECT_EQ(faces_across(walls, ids.values()), 0u);
    }
  });
}

TEST(WallsInStages, ShutWalksFromSeedsIn) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    const Dual_mesh_of dual(mesh, CGAL::parameters::edge_is_constrained_map(walls.map()));
    const Conductance conductance(dual, Dihedral_difference(mesh));
    Face_labels<Mesh> ids(mesh), raw(mesh);
    Random_walk walk(dual, conductance);
    for (std::size_t label = 0; label < 12; ++label) {  // the first answer, then edits
      const auto seed = walls.random_face();
      walk.add_seed(seed, label);
      if (label % 5 == 4) walk.remove_seed(seed);
      walk.segment(ids.map());
      walk.write_raw_labels(raw.map());
      EXPECT_EQ(faces_across(walls, ids.values()), 0u);
      EXPECT_EQ(faces_across(walls, raw.values()), 0u);
    }
  });
}

TEST(WallsInStages, CountWhereverTheyAreGiven) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    const auto np = CGAL::parameters::edge_is_constrained_map(walls.map());
    const Dihedral_difference difference(mesh);
    const Conductance open(mesh, difference), walled(mesh, difference, 1, 20, np);
    const std::vector seeds = {walls.random_face(), walls.random_face(), walls.random_face()};
    const std::vector labelled = {std::pair(seeds[0], 0), std::pair(seeds[1], 1), std::pair(seeds[2], 2)};
    Face_labels<Mesh> of_conductance(mesh), of_walk(mesh);
    std::set<std::size_t> seeded;
    for (const auto seed : seeds) seeded.insert(walls.part_of(seed));
    const std::size_t segments = segmentation_from_seeds(mesh, walled, labelled, of_conductance.map());
    EXPECT_LE(walls.parts() - seeded.size(), segments);
    EXPECT_LE(segments, walls.parts() - seeded.size() + 3);
    EXPECT_EQ(segmentation_from_seeds(mesh, open, labelled, of_walk.map(), np), segments);
    EXPECT_EQ(faces_across(walls, of_conductance.values()), 0u);
    EXPECT_EQ(of_walk.values(), of_conductance.values());
  });
}

TEST(WallsInStages, GetASeedOnEachSide) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    const auto np = CGAL::parameters::edge_is_constrained_map(walls.map());
    const auto expect_seed_in_each_part = [&](const std::vector<Mesh::Face_index>& seeds) {
      std::set<std::size_t> seeded;
      for (const auto seed : seeds) seeded.insert(walls.part_of(seed));
      EXPECT_EQ(seeded.size(), walls.parts());
    };
    std::vector<Mesh::Face_index> farthest, particles, coarse = {}, given = {walls.random_face()};
    if (walls.parts() > 1) {
      for (const auto& sampling : {Farthest_point_sampling(), Farthest_point_sampling(0.05, 0)}) {
        farthest.clear();
        EXPECT_THROW(feature_sensitive_seeds(mesh, walls.parts() - 1, std::back_inserter(farthest),
                                             std::vector<Mesh::Face_index>(), sampling, np),
                     std::invalid_argument);
        EXPECT_TRUE(farthest.empty());
        // One part has a seed already.
        farthest = given;
        feature_sensitive_seeds(mesh, walls.parts() - 1, std::back_inserter(farthest), given, sampling, np);
        EXPECT_EQ(farthest.size(), walls.parts());
        expect_seed_in_each_part(farthest);
      }
    }
    particles = given;
    feature_sensitive_seeds(mesh, walls.parts() + 3, std::back_inserter(particles), given, Particle_sampling(), np);
    expect_seed_in_each_part(particles);
    coarse_seeds(mesh, Dihedral_difference(mesh), Seed_count_stop(walls.parts()), std::back_inserter(coarse), np);
    EXPECT_EQ(coarse.size(), walls.parts());
    expect_seed_in_each_part(coarse);
  });
}

TEST(WallsInStages, AreNotMergedAcross) {
  on_walled_meshes([](const Mesh& mesh, Walls<Mesh>& walls) {
    const auto np = CGAL::parameters::edge_is_constrained_map(walls.map());
    const Dihedral_difference difference(mesh);
    Face_labels<Mesh> ids(mesh);
    std::size_t id = 0;
    for (const auto f : faces(mesh)) put(ids.map(), f, id++);
    expect_behind_walls(merge_segments(mesh, ids.map(), difference, np), mesh, walls);
    expect_behind_walls(merge_segments(mesh, ids.map(), difference, Relative_boundary_cost(), np), mesh, walls);
    expect_behind_walls(merge_segments(Dual_mesh_of(mesh, np), ids.map(), difference), mesh, walls);
  });
}

TEST(WallsInStages, DoNotHoldAnythingBackWhereTheyDoNotClose) {
  // A slit in the top of a cube.
  const Mesh mesh = meshes::surface_mesh(meshes::cube(8));
  const auto is_in_slit = [&](Mesh::Vertex_index v) {
    const auto& p = mesh.point(v);
    return p.z() == 1 && p.y() == 0.5 && p.x() > 0.1 && p.x() < 0.9;
  };
  std::size_t edges_of_slit = 0;
  Mesh::Face_index beside;
  const auto is_wall = [&](const Mesh::Edge_index& e) -> bool {
    return is_in_slit(mesh.vertex(e, 0)) && is_in_slit(mesh.vertex(e, 1));
  };
  for (const auto e : edges(mesh))
    if (is_wall(e)) {
      ++edges_of_slit;
      beside = face(halfedge(e, mesh), mesh);
    }
  ASSERT_EQ(edges_of_slit, 6u);
  const auto np =
      CGAL::parameters::edge_is_constrained_map(boost::make_function_property_map<Mesh::Edge_index>(is_wall));
  Face_labels<Mesh> ids(mesh);
  const auto hierarchy = hierarchy_via_random_walks(mesh, np);
  EXPECT_EQ(hierarchy.report().components, 1u);
  EXPECT_EQ(hierarchy.number_of_components(), 1u);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(1), np), 1u);
  EXPECT_EQ(
      segmentation_from_seeds(mesh, Conductance(mesh, Dihedral_difference(mesh)), std::vector{beside}, ids.map(), np),
      1u);
}

TEST(WallsInStages, LeaveAFaceThatTheySurroundByItself) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(2));
  const Mesh::Face_index alone(17);
  const auto np = CGAL::parameters::edge_is_constrained_map(
      boost::make_function_property_map<Mesh::Edge_index>([&](const Mesh::Edge_index& e) -> bool {
        return face(halfedge(e, mesh), mesh) == alone || face(opposite(halfedge(e, mesh), mesh), mesh) == alone;
      }));
  Face_labels<Mesh> ids(mesh);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(2), np), 2u);
  for (const auto f : faces(mesh)) EXPECT_EQ(get(ids.map(), f) == get(ids.map(), alone), f == alone);
}

TEST(WallsInStages, OnEveryEdgeMakeEveryFaceASegment) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(1));
  const auto np = CGAL::parameters::edge_is_constrained_map(
      boost::make_function_property_map<Mesh::Edge_index>([](const Mesh::Edge_index&) -> bool { return true; }));
  Face_labels<Mesh> ids(mesh);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), np), 80u);
  EXPECT_EQ(number_of(ids.values()), 80u);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Paper_segmentation(), np), 80u);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Coarse_paper_segmentation(), np), 80u);
}

}  // namespace test_walls
