// SPDX-License-Identifier: MIT

// Smooth boundaries of a mesh that is cut into tiles, where they go on from tile to tile: how much they turn there if each
// tile smooths them by itself, if tiles agree on where they cross their borders, and on the whole; and whether tiles that
// are cut along them still meet vertex by vertex.

#include "../test/boundaries_of_tiles.h"
#include "measurement.h"
#include "mesh_tiles.h"

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/tiled_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

using namespace boundaries_of_tiles;
using mesh_tiles::Labels;
using Curves = std::vector<Boundary_curve<Mesh>>;

/// A mesh in tiles, each of which is a mesh with labels.
class Tiled_mesh {
 public:
  Tiled_mesh(const std::vector<Tile>& tiles, const std::vector<std::vector<Mesh::Face_index>>& faces,
             const Labels& labels) {
    std::vector<Tile_of<Mesh>> as_read;
    std::vector<Tile_survey> surveys;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      add(tiles[t]);
      for (const Mesh::Face_index f : faces[t]) labels_[t].push_back(labels[f]);
    }
    for (const Mesh& mesh : meshes_) surveys.push_back(survey_tile(as_read.emplace_back(mesh)));
    plan_ = plan_tiles(surveys);
    std::vector<Tile_strip> strips;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      Labels in_order;
      for (const Mesh::Face_index f : as_read[t].face_descriptors) in_order.push_back(labels_[t][f]);
      strips.push_back(strip_of_tile(as_read[t], {t, plan_}, in_order));
    }
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      std::vector<Tile_strip> neighbours;
      for (const auto n : plan_.tiles[t].neighbours) neighbours.push_back(strips[n]);
      for (const Tile_crossing& crossing : crossings_of_tile({t, plan_}, strips[t], neighbours))
        crossings_.push_back(crossing);
    }
  }

  const std::vector<Tile_crossing>& crossings() const { return crossings_; }

  std::vector<Curves> curves(const std::vector<Tile_crossing>& crossings) {
    std::vector<Curves> curves;
    for (std::size_t t = 0; t < meshes_.size(); ++t)
      curves.push_back(smooth_boundaries_of_tile(meshes_[t], label_map(t), {t, plan_}, crossings));
    return curves;
  }

  /// The sides that one tile has and no other one, more than before, once all are cut along curves.
  std::size_t open_sides_when_cut(const std::vector<Curves>& curves) {
    const std::size_t before = open_sides(meshes_);
    for (std::size_t t = 0; t < meshes_.size(); ++t) {
      auto labels = meshes_[t].add_property_map<Mesh::Face_index, std::size_t>("f:label").first;
      for (std::size_t f = 0; f < labels_[t].size(); ++f)
        labels[Mesh::Face_index(static_cast<Mesh::size_type>(f))] = labels_[t][f];
      split_along_boundaries(meshes_[t], curves[t], labels);
    }
    return open_sides(meshes_) - before;
  }

 private:
  void add(const Tile& tile) {
    Mesh mesh;
    for (const Eigen::Vector3d& p : tile.points) mesh.add_vertex({p.x(), p.y(), p.z()});
    for (Dual_mesh::Index f = 0; f < tile.number_of_faces(); ++f) {
      std::vector<Mesh::Vertex_index> corners;
      for (const auto v : tile.corners[f]) corners.emplace_back(v);
      mesh.add_face(corners);
    }
    meshes_.push_back(std::move(mesh));
    labels_.emplace_back();
  }

  boost::iterator_property_map<Labels::const_iterator, boost::property_map<Mesh, boost::face_index_t>::const_type>
  label_map(std::size_t tile) const {
    return {labels_[tile].begin(), get(boost::face_index, meshes_[tile])};
  }

  Tile_plan plan_;
  std::vector<Mesh> meshes_;
  std::vector<Labels> labels_;
  std::vector<Tile_crossing> crossings_;
};

/// The turns of the whole's boundaries where they are closest to some places.
Turns turns_of_whole(const Curves& curves, const Turns& at, double distance) {
  Turns turns;
  for (const auto& [place, unused] : at) {
    const Eigen::Vector3d p(place[0], place[1], place[2]);
    double closest = std::numeric_limits<double>::infinity();
    for (const auto& curve : curves)
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const double here = (vector_to(curve.points[i].point) - p).norm();
        if (here >= closest) continue;
        closest = here;
        turns[place] = turn_between(way_from(curve, i, false, distance), way_from(curve, i, true, distance));
      }
  }
  return turns;
}

double mean_degrees(const Turns& turns) {
  constexpr double degrees = 180 / 3.14159265358979323846;
  const double sum =
      std::accumulate(turns.begin(), turns.end(), 0., [](double s, const auto& turn) { return s + turn.second; });
  return turns.empty() ? 0 : degrees * sum / static_cast<double>(turns.size());
}

double mean_edge_length(const Mesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += (vector_to(mesh.point(mesh.vertex(e, 0))) - vector_to(mesh.point(mesh.vertex(e, 1)))).norm();
  return sum / static_cast<double>(mesh.number_of_edges());
}

void measure(const std::string& name, std::size_t faces_at_most, const std::vector<std::size_t>& counts,
             std::vector<Result>& results) {
  Mesh mesh = mesh_tiles::read_subdivided(name, faces_at_most);
  const auto segments = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  segmentation_via_random_walks(mesh, segments);
  const Curves whole = smooth_boundaries(mesh, segments);
  const double chord = 2 * mean_edge_length(mesh);
  for (const std::size_t count : counts) {
    Labels tile = mesh_tiles::cut_by_grid(Dual_mesh_of(mesh), count);
    std::vector<std::vector<Mesh::Face_index>> faces;
    const std::vector<Tile> tiles = mesh_tiles::cut(mesh, tile, faces);
    Tiled_mesh tiled(tiles, faces, Labels(segments.begin(), segments.end()));
    const std::vector<Curves> curves = tiled.curves(tiled.crossings());
    const Turns alone = turns_at_borders(tiled.curves({}), chord), agreed = turns_at_borders(curves, chord);
    const double turn_of_whole = mean_degrees(turns_of_whole(whole, agreed, chord));
    const std::size_t open = tiled.open_sides_when_cut(curves);
    const std::string stem = std::filesystem::path(name).stem().string();
    std::printf("%-12s %8zu %5zu %9zu %6zu %7.1f %6zu %7.1f %7.1f %5zu\n", stem.c_str(),
                std::size_t(mesh.number_of_faces()), tiles.size(), tiled.crossings().size(), alone.size(),
                mean_degrees(alone), agreed.size(), mean_degrees(agreed), turn_of_whole, open);
    std::fflush(stdout);
    Result& result = results.emplace_back("tiled_boundaries");
    result.add("mesh", stem).add("faces", std::size_t(mesh.number_of_faces())).add("tiles", tiles.size());
    result.add("crossings", tiled.crossings().size());
    result.add("places_alone", alone.size()).add("turn_alone", mean_degrees(alone));
    result.add("places", agreed.size()).add("turn", mean_degrees(agreed)).add("turn_of_whole", turn_of_whole);
    result.add("open_sides", open);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> meshes = {"hand"};
  std::size_t faces = 120000;
  std::vector<std::size_t> tiles = {2, 8};
  CLI::App app(
      "Segments meshes, cuts them into boxes, and smooths the boundaries between segments tile by tile: by themselves, "
      "and "
      "with crossings that neighbours agree on. Prints the number of crossings; for both, the places where boundaries "
      "of "
      "two tiles end in one point, and their mean turn there in degrees, between chords of two mean edges; the turn of "
      "the "
      "whole's boundaries beside the latter; and the sides that are open once the tiles are cut along their "
      "boundaries.");
  app.add_option("--meshes", meshes, "Files, or names of CGAL's data meshes")->delimiter(',')->capture_default_str();
  app.add_option("--faces", faces, "Meshes are subdivided up to so many")->capture_default_str();
  app.add_option("--tiles", tiles, "How many")->delimiter(',')->check(CLI::PositiveNumber)->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::printf("%-12s %8s %5s %9s %6s %7s %6s %7s %7s %5s\n", "mesh", "faces", "tiles", "crossings", "alone", "turn",
              "agreed", "turn", "whole", "open");
  std::vector<Result> results;
  for (const std::string& mesh : meshes) measure(mesh, faces, tiles, results);
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_tiled_boundaries: " << error.what() << '\n';
  return 1;
}
