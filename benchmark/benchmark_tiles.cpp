// SPDX-License-Identifier: MIT

// A mesh cut into tiles beside the same mesh as a whole: how far the segments agree, whether tiles show in them, and what
// it costs.

#include "measurement.h"
#include "mesh_tiles.h"
#include "segmentation_measures.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include <boost/property_map/property_map.hpp>

#ifdef RW_SEGMENTATION_WITH_METIS
#include <metis.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

struct Arguments {
  std::vector<std::string> meshes = {"hand"};
  std::size_t faces = 640000;
  std::vector<std::size_t> tiles = {2, 8, 32};
  std::vector<std::string> cuts = {"grid"};
};

using namespace mesh_tiles;
using Face = Mesh::Face_index;

// ---- Cutting ----

/// The tile of each face by METIS: as many faces in each, and few sides between them.
Labels cut_by_metis([[maybe_unused]] const Dual_mesh_of<Mesh>& mesh, [[maybe_unused]] std::size_t tiles) {
#ifdef RW_SEGMENTATION_WITH_METIS
  std::vector<idx_t> row = {0}, neighbours;
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
    for (const auto& neighbour : mesh.graph().neighbours(f)) neighbours.push_back(static_cast<idx_t>(neighbour.face));
    row.push_back(static_cast<idx_t>(neighbours.size()));
  }
  auto faces = static_cast<idx_t>(mesh.number_of_faces()), constraints = idx_t(1), parts = static_cast<idx_t>(tiles);
  idx_t cut = 0;
  std::vector<idx_t> part(mesh.number_of_faces());
  if (METIS_PartGraphKway(&faces, &constraints, row.data(), neighbours.data(), nullptr, nullptr, nullptr, &parts,
                          nullptr, nullptr, nullptr, &cut, part.data()) != METIS_OK)
    throw std::runtime_error("METIS has failed");
  Labels tile(part.size());
  for (Dual_mesh::Index f = 0; f < tile.size(); ++f) tile[mesh.face(f)] = static_cast<std::size_t>(part[f]);
  return tile;
#else
  throw std::runtime_error("--cuts metis needs METIS");
#endif
}

// ---- Measuring ----

/// The share of the length of the edges between tiles that lies between segments.
double border_share(const Mesh& mesh, const Labels& tile, const Labels& segment) {
  double between_tiles = 0, between_segments = 0;
  for (const auto e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const Face f = mesh.face(mesh.halfedge(e, 0)), g = mesh.face(mesh.halfedge(e, 1));
    if (tile[f] == tile[g]) continue;
    const double length =
        std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
    between_tiles += length;
    if (segment[f] != segment[g]) between_segments += length;
  }
  return between_tiles > 0 ? between_segments / between_tiles : 0;
}

/// For each segment the face whose centroid is closest to that of the segment.
std::map<std::size_t, Dual_mesh::Index> middle_faces(const Dual_mesh_of<Mesh>& mesh, const Labels& segment) {
  std::map<std::size_t, Eigen::Vector4d> sums;  // of centroid and 1, times area
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
    Eigen::Vector4d& sum = sums.emplace(segment[mesh.face(f)], Eigen::Vector4d::Zero()).first->second;
    sum += mesh.area(f) * mesh.centroid(f).homogeneous();
  }
  std::map<std::size_t, Dual_mesh::Index> middle;
  const auto distance = [&](Dual_mesh::Index f) {
    return (mesh.centroid(f) - sums.at(segment[mesh.face(f)]).hnormalized()).norm();
  };
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
    const auto [place, is_new] = middle.emplace(segment[mesh.face(f)], f);
    if (distance(f) < distance(place->second)) place->second = f;
  }
  return middle;
}

/// The labels of walks over the faces of the whole from a seed in the middle of each segment.
Labels walk_over_faces(const Dual_mesh_of<Mesh>& mesh, const std::map<std::size_t, Dual_mesh::Index>& seeds) {
  const Dual_mesh_of shape = smoothed_shape(mesh);
  Random_walk walk(shape, Conductance(shape, Dihedral_difference(shape, seeded_concavity())));
  for (const auto& [label, face] : seeds) walk.add_seed(mesh.face(face), label);
  Labels labels(mesh.number_of_faces());
  walk.segment(boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh.mesh())));
  return labels;
}

/// The share of faces whose labels differ.
double share_of_different(const Labels& a, const Labels& b) {
  std::size_t different = 0;
  for (std::size_t f = 0; f < a.size(); ++f) different += a[f] != b[f];
  return static_cast<double>(different) / static_cast<double>(a.size());
}

void measure(const std::string& name, const Arguments& arguments, std::vector<Result>& results) {
  Mesh mesh = read_subdivided(name, arguments.faces);
  const auto labels = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  const auto as_labels = [&] { return Labels(labels.begin(), labels.end()); };
  Automatic_segmentation policy;
  policy.seedings = 1;  // as tiles have
  const auto segment = [&] {
    const Stopwatch watch;
    segmentation_via_random_walks<CGAL::Sequential_tag>(mesh, labels, policy);
    return watch.milliseconds();
  };
  policy.reduction.largest_direct = 0;
  const double whole_ms = segment();
  const Labels usual = as_labels();
  policy.seeding.sampling = Farthest_point_sampling(policy.seeding.sampling.normal_weight(), mesh.number_of_faces());
  segment();
  const Labels whole = as_labels();
  policy.reduction.largest_direct = mesh.number_of_faces();
  segment();
  const Labels direct = as_labels();
  const std::size_t segments_of_whole = std::set<std::size_t>(whole.begin(), whole.end()).size();
  const double of_seeds = segmentation_measures::Overlaps(usual, whole).rand_index_error();
  const double of_reduction = segmentation_measures::Overlaps(direct, whole).rand_index_error();

  const Dual_mesh_of dual(mesh);
  const auto middle = middle_faces(dual, whole);
  const Labels walked = walk_over_faces(dual, middle);
  std::vector<Seed_point> seeds;
  for (const auto& [label, face] : middle)
    seeds.push_back({dual.unit() * dual.centroid(face) + dual.origin(), static_cast<Dual_mesh::Index>(label)});
  for (const std::string& kind : arguments.cuts)
    for (const std::size_t count : arguments.tiles) {
      Labels tile = kind == "metis" ? cut_by_metis(dual, count) : cut_by_grid(dual, count);
      std::vector<std::vector<Face>> faces;
      const std::vector<Tile> tiles = cut(mesh, tile, faces);
      const Stopwatch watch;
      const Tiled_hierarchy hierarchy = hierarchy_of_tiles(tiles);
      const std::size_t segments = Cost_threshold_stop(1)(hierarchy.tree);
      const auto of_tiles = hierarchy.segments(segments);
      const double tiled_ms = watch.milliseconds();
      const Labels tiled = of_whole(of_tiles, faces);
      const double from_seeds = share_of_different(walked, of_whole(segments_of_tiles(tiles, seeds), faces));
      const double error = segmentation_measures::Overlaps(whole, tiled).rand_index_error();
      const double share = border_share(mesh, tile, tiled), share_of_whole = border_share(mesh, tile, whole);
      std::printf("%-12s %8zu %-6s %5zu %9.4f %9.4f %9.4f %8.4f %8.4f %6zu %6zu %8.4f %9.0f %9.0f %6.2f\n",
                  std::filesystem::path(name).stem().c_str(), std::size_t(mesh.number_of_faces()), kind.c_str(),
                  tiles.size(), error, of_reduction, of_seeds, share, share_of_whole, segments, segments_of_whole,
                  from_seeds, tiled_ms, whole_ms, tiled_ms / whole_ms);
      std::fflush(stdout);
      Result& result = results.emplace_back("tiles");
      result.add("mesh", std::filesystem::path(name).stem().string()).add("faces", std::size_t(mesh.number_of_faces()));
      result.add("cut", kind).add("tiles", tiles.size()).add("error", error).add("error_of_reduction", of_reduction);
      result.add("error_of_seeds_over_clusters", of_seeds);
      result.add("border_share", share).add("border_share_of_whole", share_of_whole);
      result.add("segments", segments).add("segments_of_whole", segments_of_whole);
      result.add("different_from_seeds", from_seeds);
      result.add("tiled_ms", tiled_ms).add("whole_ms", whole_ms);
    }
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Cuts meshes into tiles, segments them tile by tile and as a whole, and compares: the Rand index error between "
      "both, where seeds are placed over faces and walks run over clusters; that between two ways to segment the "
      "whole, "
      "walks over faces and over clusters, and between two more, seeds placed over faces and over clusters; the share "
      "of "
      "the borders between tiles that lies between segments, tiled and whole; segments; the share of faces that get "
      "another label from a seed in each segment of the whole, tiled or by walks over the faces of the whole; time.");
  app.add_option("--meshes", arguments.meshes, "Files, or names of CGAL's data meshes")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--faces", arguments.faces, "Meshes are subdivided up to so many")->capture_default_str();
  app.add_option("--tiles", arguments.tiles, "How many")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--cuts", arguments.cuts, "Into boxes, or by METIS where it is there")
      ->delimiter(',')
      ->check(CLI::IsMember({"grid", "metis"}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::printf("%-12s %8s %-6s %5s %9s %9s %9s %8s %8s %6s %6s %8s %9s %9s %6s\n", "mesh", "faces", "cut", "tiles",
              "error", "reduction", "of seeds", "border", "whole", "segm.", "whole", "seeds", "tiled ms", "whole ms",
              "ratio");
  std::vector<Result> results;
  for (const std::string& mesh : arguments.meshes) measure(mesh, arguments, results);
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_tiles: " << error.what() << '\n';
  return 1;
}
