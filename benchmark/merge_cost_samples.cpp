// SPDX-License-Identifier: MIT

// Writes what train_merge_cost.py learns the merge cost from: each pair of neighbouring regions that merging by
// Size_aware_cost looks at on meshes of the Princeton Segmentation Benchmark, and how far people leave the two in one
// segment. The data are not part of this package, see princeton_data.h.
//
// The output holds a line with the names of the columns, then a row of 32-bit floats for each pair: the number of the mesh,
// the share of the pairs of faces across the two regions that people have in one segment, the share of all pairs of the
// mesh's faces that these are, and the features.

#include "princeton_data.h"

#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using namespace princeton;

namespace {

using Dual = Dual_mesh_of<Mesh>;
using Index = Dual_mesh::Index;
using Features = internal::Merge_features;

/// By face of a mesh: how many of the faces that people labelled it stands for, and how many of these each person has in
/// each segment.
class Opinions {
 public:
  explicit Opinions(const Subject& subject) : people_(subject.people.size()), faces_(subject.nearest.size()) {
    std::vector<std::map<std::size_t, std::size_t>> column(people_);
    for (std::size_t p = 0; p < people_; ++p)
      for (const std::size_t label : subject.people[p])
        if (column[p].emplace(label, columns_).second) ++columns_;
    of_face_.resize(num_faces(subject.mesh));
    for (std::size_t i = 0; i < faces_; ++i)
      for (std::size_t p = 0; p < people_; ++p)
        of_face_[subject.nearest[i]].push_back(column[p].at(subject.people[p][i]));
  }

  /// What people say of a region.
  struct Votes {
    double faces = 0;
    std::vector<double> of_segment;  // of every person
  };

  Votes of(Face face) const {
    Votes votes = {static_cast<double>(of_face_[face].size()) / static_cast<double>(people_), {}};
    votes.of_segment.assign(columns_, 0);
    for (const std::size_t column : of_face_[face]) ++votes.of_segment[column];
    return votes;
  }

  /// The share of the pairs of faces across two regions that people have in one segment.
  double agreement(const Votes& a, const Votes& b) const {
    double pairs = 0;
    for (std::size_t i = 0; i < columns_; ++i) pairs += a.of_segment[i] * b.of_segment[i];
    return pairs / (static_cast<double>(people_) * a.faces * b.faces);
  }

  /// The pairs of faces across two regions, as a share of the square of all faces.
  double share(const Votes& a, const Votes& b) const {
    return a.faces * b.faces / static_cast<double>(faces_) / static_cast<double>(faces_);
  }

 private:
  std::size_t people_, faces_, columns_ = 0;
  std::vector<std::vector<std::size_t>> of_face_;
};

/// Size_aware_cost, which writes down whatever it is asked.
class Recording_cost {
 public:
  struct Region {
    Learned_cost::Region region;
    Opinions::Votes votes;
  };
  using Boundary = Learned_cost::Boundary;

  Recording_cost(Learned_cost cost, std::shared_ptr<const Opinions> opinions, std::size_t number,
                 std::vector<float>& rows)
      : cost_(std::move(cost)), opinions_(std::move(opinions)), number_(number), rows_(&rows) {}

  Region region(const Dual& mesh, Index face) const {
    return {cost_.region(mesh, face), opinions_->of(mesh.face(face))};
  }
  void join(Region& region, const Region& other) const {
    cost_.join(region.region, other.region);
    region.votes.faces += other.votes.faces;
    for (std::size_t i = 0; i < region.votes.of_segment.size(); ++i)
      region.votes.of_segment[i] += other.votes.of_segment[i];
  }
  Boundary boundary(const Dual& mesh, Index edge, double difference) const {
    return cost_.boundary(mesh, edge, difference);
  }
  double operator()(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const {
    if (cost_.knows_thickness(a.region, b.region) && a.votes.faces > 0 && b.votes.faces > 0) {
      const Features features(a.region.shape, b.region.shape, boundary.common.shape, boundary.outline_of_first.shape,
                              boundary.outline_of_second.shape);
      for (const double x :
           {static_cast<double>(number_), opinions_->agreement(a.votes, b.votes), opinions_->share(a.votes, b.votes)})
        rows_->push_back(static_cast<float>(x));
      for (std::size_t i = 0; i < Features::count; ++i) rows_->push_back(static_cast<float>(features[i]));
    }
    return cost_.size_aware_cost(a.region, b.region, boundary);
  }

 private:
  Learned_cost cost_;
  std::shared_ptr<const Opinions> opinions_;
  std::size_t number_;
  std::vector<float>* rows_;
};

/// Adds the samples of a mesh to the rows.
void record(const Subject& subject, std::vector<float>& rows) {
  const auto opinions = std::make_shared<const Opinions>(subject);
  hierarchy_via_random_walks(subject.mesh, Automatic_segmentation().with_merge_cost([&](const Dual& mesh) {
    return Recording_cost(Learned_cost_policy()(mesh), opinions, subject.number, rows);
  }));
}

void write(const std::string& path, const std::vector<float>& rows) {
  const std::string temporary = path + ".part";
  std::ofstream file(temporary, std::ios::binary);
  file << "mesh agreement share";
  for (const char* name : Features::names) file << ' ' << name;
  file << '\n';
  file.write(reinterpret_cast<const char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(float)));
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
  file.close();
  std::filesystem::rename(temporary, path);
}

}  // namespace

int main(int argc, char* argv[]) {
  CLI::App app("Samples from which the merge cost is learned");
  std::string data, meshes, output;
  Changes changes;
  app.add_option("--data", data, "folder with data/off and data/seg/Benchmark")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--meshes", meshes, "file with the numbers of the meshes; default: all in the folder");
  app.add_option("--noise", changes.noise, "displace the vertices, in percent of the diagonal")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--faces", changes.faces, "factor for the number of faces: a power of 4, or less than 1")
      ->check(CLI::Range(0.01, 256.));
  app.add_option("--output", output, "file that is written")->required();
  CLI11_PARSE(app, argc, argv);

  try {
    const auto numbers =
        meshes.empty() ? numbers_in_folder(std::filesystem::path(data) / "data" / "off") : numbers_in_file(meshes);
    if (numbers.empty()) throw std::runtime_error(data + ": no meshes");
    std::vector<float> rows;
    for (const std::size_t number : numbers) record(read_subject(data, number, changes), rows);
    write(output, rows);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "merge_cost_samples: %s\n", error.what());
    return 1;
  }
}
