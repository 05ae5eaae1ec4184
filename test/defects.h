// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_DEFECTS_H
#define RW_SEGMENTATION_TEST_DEFECTS_H

// Ways in which files of meshes are bad, each by its name, made from any sound mesh. What is damaged is chosen by chance,
// the same everywhere.

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace defects {

/// Points, and faces as the numbers of their corners.
struct Soup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<std::size_t>> faces;
};

/// Damages a soup.
using Damage = std::function<void(Soup&, std::mt19937&)>;
/// Damages the text of an OFF file.
using Text_damage = std::function<void(std::string&, std::mt19937&)>;

struct Defect {
  std::string name;
  Damage soup = [](Soup&, std::mt19937&) {};
  Text_damage text = [](std::string&, std::mt19937&) {};
};

inline std::string off_text(const Soup& soup) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << soup.points.size() << ' ' << soup.faces.size() << " 0\n";
  for (const Eigen::Vector3d& p : soup.points) text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& face : soup.faces) {
    text << face.size();
    for (const std::size_t corner : face) text << ' ' << corner;
    text << '\n';
  }
  return text.str();
}

/// The OFF file of a soup with a defect.
inline std::string damaged_off(Soup soup, const Defect& defect) {
  std::mt19937 random(7);
  defect.soup(soup, random);
  std::string text = off_text(soup);
  defect.text(text, random);
  return text;
}

/// Calls `damage(face)` for about a tenth of the faces that there are now.
inline Damage some_faces(const std::function<void(Soup&, std::size_t, std::mt19937&)>& damage) {
  return [damage](Soup& soup, std::mt19937& random) {
    const std::size_t size = soup.faces.size();
    for (std::size_t f = 0; f < size; ++f)
      if (random() % 10 == 0) damage(soup, f, random);
  };
}

inline Damage all_points(const std::function<void(Eigen::Vector3d&, std::mt19937&)>& damage) {
  return [damage](Soup& soup, std::mt19937& random) {
    for (Eigen::Vector3d& p : soup.points) damage(p, random);
  };
}

/// Gives a face corners of its own, a little aside.
inline void separate(Soup& soup, std::size_t f, double aside) {
  for (std::size_t& corner : soup.faces[f]) {
    soup.points.push_back(soup.points[corner] * (1 + aside));
    corner = soup.points.size() - 1;
  }
}

/// Writes a word in place of a number in the middle of the file.
inline Text_damage word(const std::string& replacement) {
  return [replacement](std::string& text, std::mt19937&) {
    const std::size_t begin = text.find(' ', text.size() / 3) + 1, end = text.find_first_of(" \n", begin);
    text.replace(begin, end - begin, replacement);
  };
}

/// Changes the number of vertices or that of faces in the header.
inline Text_damage count(std::size_t place, const std::function<std::size_t(std::size_t)>& change) {
  return [place, change](std::string& text, std::mt19937&) {
    std::istringstream header(text.substr(4, text.find('\n', 4)));
    std::array<std::size_t, 3> counts{};
    for (std::size_t& c : counts) header >> c;
    counts[place] = change(counts[place]);
    std::ostringstream line;
    line << counts[0] << ' ' << counts[1] << ' ' << counts[2];
    text.replace(4, text.find('\n', 4) - 4, line.str());
  };
}

inline std::vector<Defect> all() {
  std::vector<Defect> defects;
  const auto soup = [&](const char* name, const Damage& damage) {
    defects.emplace_back();
    defects.back().name = name;
    defects.back().soup = damage;
  };
  const auto text = [&](const char* name, const Text_damage& damage) {
    defects.emplace_back();
    defects.back().name = name;
    defects.back().text = damage;
  };
  const auto corner = [](Soup& s, std::mt19937& random) { return random() % s.points.size(); };

  // How faces are joined.
  soup("duplicate_vertices", some_faces([](Soup& s, std::size_t f, std::mt19937&) { separate(s, f, 0); }));
  soup("near_duplicate_vertices", some_faces([](Soup& s, std::size_t f, std::mt19937&) { separate(s, f, 1e-12); }));
  soup("separate_faces", [](Soup& s, std::mt19937&) {
    for (std::size_t f = 0; f < s.faces.size(); ++f) separate(s, f, 0);
  });
  soup("flipped_faces",
       some_faces([](Soup& s, std::size_t f, std::mt19937&) { std::reverse(s.faces[f].begin(), s.faces[f].end()); }));
  soup("flipped_patch", [](Soup& s, std::mt19937&) {
    const double middle = s.points[s.faces[0][0]].x();
    for (auto& face : s.faces)
      if (s.points[face[0]].x() < middle) std::reverse(face.begin(), face.end());
  });
  soup("inside_out", [](Soup& s, std::mt19937&) {
    for (auto& face : s.faces) std::reverse(face.begin(), face.end());
  });
  soup("duplicate_faces",
       some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.faces.push_back(std::vector(s.faces[f])); }));
  soup("non_manifold_edges", some_faces([](Soup& s, std::size_t f, std::mt19937&) {
         s.points.push_back(1.1 * s.points[s.faces[f][2]]);
         s.faces.push_back({s.faces[f][0], s.faces[f][1], s.points.size() - 1});
       }));
  soup("non_manifold_vertices",
       some_faces([=](Soup& s, std::size_t f, std::mt19937& random) { s.faces[f][0] = corner(s, random); }));
  soup("holes", [](Soup& s, std::mt19937& random) {
    s.faces.erase(std::remove_if(s.faces.begin(), s.faces.end(), [&](const auto&) { return random() % 10 == 0; }),
                  s.faces.end());
  });
  soup("t_junctions", some_faces([](Soup& s, std::size_t f, std::mt19937&) {
         const std::vector<std::size_t> face = s.faces[f];
         s.points.push_back((s.points[face[0]] + s.points[face[1]]) / 2);
         s.faces[f][1] = s.points.size() - 1;
         std::vector<std::size_t> rest(face.begin() + 1, face.end());
         rest.push_back(s.points.size() - 1);
         s.faces.push_back(rest);
       }));
  soup("isolated_faces", some_faces([](Soup& s, std::size_t f, std::mt19937&) {
         s.faces.push_back(std::vector(s.faces[f]));
         separate(s, s.faces.size() - 1, 2);
       }));
  soup("isolated_vertices",
       some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.points.push_back(3 * s.points[s.faces[f][0]]); }));
  soup("repeated_corners", some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.faces[f][1] = s.faces[f][0]; }));
  soup("faces_of_two_corners", some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.faces[f].resize(2); }));
  soup("faces_of_no_corners", some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.faces[f].clear(); }));

  // Where points are.
  soup("zero_area_faces",
       some_faces([](Soup& s, std::size_t f, std::mt19937&) { s.points[s.faces[f][0]] = s.points[s.faces[f][1]]; }));
  soup("needles", some_faces([](Soup& s, std::size_t f, std::mt19937&) {
         s.points[s.faces[f][0]] = s.points[s.faces[f][1]] + 1e-9 * (s.points[s.faces[f][2]] - s.points[s.faces[f][1]]);
       }));
  soup("self_intersections", [](Soup& s, std::mt19937&) {
    const std::size_t points = s.points.size(), faces = s.faces.size();
    const Eigen::Vector3d shift = (s.points[s.faces[0][0]] - s.points[s.faces[faces / 2][0]]) / 3;
    for (std::size_t v = 0; v < points; ++v) s.points.push_back(s.points[v] + shift);
    for (std::size_t f = 0; f < faces; ++f) {
      s.faces.push_back(std::vector(s.faces[f]));
      for (std::size_t& c : s.faces.back()) c += points;
    }
  });
  soup("noise", all_points([](Eigen::Vector3d& p, std::mt19937& random) {
         for (double& x : p) x *= 1 + 1e-10 * static_cast<double>(random() % 100000000);
       }));
  soup("flat", all_points([](Eigen::Vector3d& p, std::mt19937&) { p.z() = 0; }));
  soup("single_point", all_points([](Eigen::Vector3d& p, std::mt19937&) { p.setOnes(); }));
  soup("huge", all_points([](Eigen::Vector3d& p, std::mt19937&) { p *= 1e150; }));
  soup("tiny", all_points([](Eigen::Vector3d& p, std::mt19937&) { p *= 1e-150; }));
  soup("far_away", all_points([](Eigen::Vector3d& p, std::mt19937&) { p.array() += 1e8; }));
  soup("one_point_far_away", [](Soup& s, std::mt19937&) { s.points[s.faces[0][0]] *= 1e9; });

  // How the file is written.
  text("not_a_number", word("nan"));
  text("infinite", word("inf"));
  text("words", word("three"));
  text("fewer_vertices_than_promised", count(0, [](std::size_t n) { return n + 1; }));
  text("more_vertices_than_promised", count(0, [](std::size_t n) { return n - 1; }));
  text("fewer_faces_than_promised", count(1, [](std::size_t n) { return n + 1; }));
  text("billions_promised", count(1, [](std::size_t) { return std::size_t(4000000000); }));
  text("truncated", [](std::string& t, std::mt19937&) { t.resize(t.size() / 2); });
  text("garbage", [](std::string& t, std::mt19937& random) {
    for (std::size_t i = t.size() / 2; i < t.size() / 2 + 20 && i < t.size(); ++i) t[i] = static_cast<char>(random());
  });
  text("empty", [](std::string& t, std::mt19937&) { t.clear(); });
  text("windows_line_ends", [](std::string& t, std::mt19937&) {
    for (std::size_t i = 0; (i = t.find('\n', i)) != std::string::npos; i += 2) t.insert(i, 1, '\r');
  });
  return defects;
}

}  // namespace defects

#endif
