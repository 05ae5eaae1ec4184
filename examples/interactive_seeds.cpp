// SPDX-License-Identifier: MIT

// An editing session: seeds are added, removed and taken back, and each edit is answered at once.
//
//   interactive_seeds MESH < COMMANDS
//
// Commands, one a line: "add FACE LABEL", "remove FACE", "undo". After each the segments are listed: label and number
// of faces.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <cstddef>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Walk = RW_segmentation::Random_walk<Mesh>;

// A face and the label it had as a seed before the edit, if it was one: all that undoing takes.
struct Edit {
  Mesh::Face_index face;
  std::optional<std::size_t> label_before;
};

void set_seed(Walk& walk, Mesh::Face_index face, std::optional<std::size_t> label) {
  if (label)
    walk.add_seed(face, *label);
  else
    walk.remove_seed(face);
}

void execute(const std::string& line, Walk& walk, std::vector<Edit>& edits) {
  std::istringstream words(line);
  std::string command;
  Mesh::size_type face = 0;
  std::size_t label = 0;
  words >> command;
  if (command == "add" && words >> face >> label) {
    edits.push_back({Mesh::Face_index(face), walk.label_of_seed(Mesh::Face_index(face))});
    walk.add_seed(Mesh::Face_index(face), label);
  } else if (command == "remove" && words >> face) {
    edits.push_back({Mesh::Face_index(face), walk.label_of_seed(Mesh::Face_index(face))});
    walk.remove_seed(Mesh::Face_index(face));
  } else if (command == "undo" && !edits.empty()) {
    set_seed(walk, edits.back().face, edits.back().label_before);
    edits.pop_back();
  } else {
    throw std::invalid_argument("not understood: " + line);
  }
}

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: interactive_seeds MESH < COMMANDS\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;

  const RW_segmentation::Dual_mesh_of dual(mesh);
  const RW_segmentation::Conductance conductance(dual, RW_segmentation::Dihedral_difference(dual));
  Walk walk(dual, conductance);
  std::vector<Edit> edits;

  for (std::string line; std::getline(std::cin, line);) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      execute(line, walk, edits);
      if (walk.seeds().empty()) {
        std::cout << line << ": no seeds\n";
        continue;
      }
      walk.segment(segment);
    } catch (const std::invalid_argument& error) {
      std::cerr << error.what() << '\n';
      return 1;
    }
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;

    std::map<std::size_t, std::size_t> faces_of;
    for (const auto f : mesh.faces()) ++faces_of[segment[f]];
    std::cout << line << ':';
    for (const auto& [label, faces] : faces_of) std::cout << ' ' << label << '=' << faces;
    std::cout << "  (" << time.count() << " ms)\n";
    walk.anticipate();  // while the user looks at the answer
  }
}
