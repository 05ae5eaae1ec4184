// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SEEDS_H
#define SEGMENT_MESH_SEEDS_H

#include "../mesh_files/Text.h"
#include "../mesh_files/read_content.h"
#include "Closest_face.h"
#include "Oriented_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace segment_mesh {

/// A seed as the user gives it.
struct Seed_argument {
  std::variant<std::size_t, Point> place;  ///< the number of a face in the file, or a point
  std::optional<std::size_t> label;
  std::string text;
};

/// Reads `FACE` or `X,Y,Z`, and `=LABEL` after it if the label is given. Blanks may stand for the commas.
/// \throws std::invalid_argument if the text is neither
inline Seed_argument seed_argument(const std::string& text) {
  using mesh_files::number_in;
  const auto fail = [&] {
    return std::invalid_argument(mesh_files::printable(text) +
                                 " is no seed: give FACE or X,Y,Z, or FACE=LABEL or X,Y,Z=LABEL");
  };
  Seed_argument seed;
  seed.text = text;
  std::string place = text.substr(0, text.find('='));
  std::replace(place.begin(), place.end(), ',', ' ');
  std::istringstream words(place);
  std::vector<std::string> numbers;
  for (std::string word; words >> word;) numbers.push_back(word);

  if (numbers.size() == 1) {
    const auto face = number_in<std::size_t>(numbers[0]);
    if (!face) throw fail();
    seed.place = *face;
  } else if (numbers.size() == 3) {
    const auto x = number_in<double>(numbers[0]), y = number_in<double>(numbers[1]), z = number_in<double>(numbers[2]);
    if (!x || !y || !z || !std::isfinite(*x) || !std::isfinite(*y) || !std::isfinite(*z)) throw fail();
    seed.place = Point(*x, *y, *z);
  } else {
    throw fail();
  }
  if (place.size() < text.size()) {
    std::string label = text.substr(place.size() + 1);
    label.erase(std::remove(label.begin(), label.end(), ' '), label.end());
    const auto number = number_in<std::int32_t>(label);  // what other programs hold labels in
    if (!number || *number < 0) throw fail();
    seed.label = static_cast<std::size_t>(*number);
  }
  return seed;
}

/// Reads a file with one seed a line; blank lines and what follows a `#` are passed over.
inline std::vector<Seed_argument> read_seeds(const std::string& path) {
  const std::string content = mesh_files::read_content(path);
  mesh_files::Text text(path, content);
  std::vector<Seed_argument> seeds;
  while (text.next_line()) {
    std::string line;
    while (!text.at_end_of_line()) (line += line.empty() ? "" : " ") += text.word();
    try {
      seeds.push_back(seed_argument(line));
    } catch (const std::invalid_argument& error) {
      text.fail(error.what());
    }
  }
  return seeds;
}

/// Gives each seed without a label the lowest one that is not yet in use.
inline void complete_labels(std::vector<Seed_argument>& seeds) {
  std::set<std::size_t> used;
  for (const Seed_argument& seed : seeds)
    if (seed.label) used.insert(*seed.label);
  std::size_t next = 0;
  for (Seed_argument& seed : seeds) {
    if (seed.label) continue;
    while (used.count(next) > 0) ++next;
    seed.label = next++;
  }
}

using Face_label = std::pair<Mesh::Face_index, std::size_t>;

/// The faces that seeds with labels stand for.
/// \throws std::invalid_argument if there is no such face, or one gets two labels
inline std::vector<Face_label> seed_faces(const std::vector<Seed_argument>& seeds, const Oriented_mesh& input) {
  std::optional<Closest_face> closest;
  std::vector<Face_label> result;
  std::map<Mesh::Face_index, std::size_t> label_of;
  for (const Seed_argument& seed : seeds) {
    const auto fail = [&](const std::string& cause) {
      return std::invalid_argument("seed " + seed.text + ": " + cause);
    };
    if (input.mesh.number_of_faces() == 0) throw fail("the mesh has no faces");
    Mesh::Face_index face;
    if (const Point* point = std::get_if<Point>(&seed.place)) {
      if (!closest) closest.emplace(input.mesh);
      face = (*closest)(*point);
    } else {
      const std::size_t number = std::get<std::size_t>(seed.place);
      if (number >= input.mesh_face.size())
        throw fail("the file has " + counted(input.mesh_face.size(), "face") + ", the first is face 0");
      face = input.mesh_face[number];
      if (face == Mesh::null_face()) throw fail("this face was left out of the mesh");
    }
    const auto [found, is_new] = label_of.emplace(face, *seed.label);
    if (!is_new && found->second != *seed.label)
      throw fail("another seed gives the same face the label " + std::to_string(found->second));
    if (is_new) result.emplace_back(face, *seed.label);
  }
  return result;
}

}  // namespace segment_mesh

#endif
