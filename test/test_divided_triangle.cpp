// SPDX-License-Identifier: MIT

// Triangles cut along chords, against all ways to cut them.

#include <RW_segmentation/internal/boundary/Divided_triangle.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace test_divided_triangle {

using RW_segmentation::internal::Divided_triangle;
using Chord = Divided_triangle::Chord;

namespace {

struct Outline {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::set<std::size_t>> sides;  ///< that a point lies on; a corner lies on two
};

Outline random_outline(std::mt19937& random, std::size_t most_on_a_side) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::array<Eigen::Vector3d, 3> corners = {
      Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1 + uniform(random), 0, 0.5), Eigen::Vector3d(uniform(random), 1, 0.2)};
  Outline outline;
  for (std::size_t side = 0; side < 3; ++side) {
    std::set<double> places = {0};
    for (std::size_t k = random() % (most_on_a_side + 1); k > 0; --k) places.insert(0.05 + 0.9 * uniform(random));
    for (const double t : places) {
      outline.points.emplace_back((1 - t) * corners[side] + t * corners[(side + 1) % 3]);
      outline.sides.push_back(t == 0 ? std::set{(side + 2) % 3, side} : std::set{side});
    }
  }
  return outline;
}

bool lie_on_one_side(const Outline& outline, std::size_t a, std::size_t b) {
  return std::any_of(outline.sides[a].begin(), outline.sides[a].end(),
                     [&](std::size_t side) { return outline.sides[b].count(side) > 0; });
}

bool cross(const Chord& first, const Chord& second) {
  const auto [a, b] = std::minmax(first[0], first[1]);
  const auto is_between = [a = a, b = b](std::size_t i) { return a < i && i < b; };
  const auto is_beyond = [a = a, b = b](std::size_t i) { return i < a || b < i; };
  return (is_between(second[0]) && is_beyond(second[1])) || (is_beyond(second[0]) && is_between(second[1]));
}

/// As many chords from side to side as come by chance without a crossing.
std::vector<Chord> random_chords(const Outline& outline, std::size_t trials, std::mt19937& random) {
  std::vector<Chord> chords;
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const Chord chord = {random() % outline.points.size(), random() % outline.points.size()};
    const Chord reverse = {chord[1], chord[0]};
    if (chord[0] != chord[1] && !lie_on_one_side(outline, chord[0], chord[1]) &&
        std::none_of(chords.begin(), chords.end(),
                     [&](const Chord& other) { return other == chord || other == reverse || cross(chord, other); }))
      chords.push_back(chord);
  }
  return chords;
}

double relative_height(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() / longest;
}

/// The lowest relative height of the best of all triangulations of the polygon that hold the chords; -1 without one.
double best_quality(const std::vector<Eigen::Vector3d>& points, const std::vector<std::size_t>& polygon,
                    const std::vector<Chord>& chords) {
  if (polygon.size() < 3) return std::numeric_limits<double>::infinity();
  const std::size_t first = polygon.front(), last = polygon.back();
  double best = -1;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {  // the third corner of the triangle at the last side
    const std::array<Chord, 2> sides = {Chord{first, polygon[k]}, Chord{polygon[k], last}};
    if (std::any_of(chords.begin(), chords.end(),
                    [&](const Chord& chord) { return cross(sides[0], chord) || cross(sides[1], chord); }))
      continue;
    const auto middle = polygon.begin() + static_cast<std::ptrdiff_t>(k);
    best = std::max(best, std::min({relative_height(points[first], points[polygon[k]], points[last]),
                                    best_quality(points, {polygon.begin(), middle + 1}, chords),
                                    best_quality(points, {middle, polygon.end()}, chords)}));
  }
  return best;
}

/// The triangles by their numbers: ears are cut off one after the other.
std::vector<std::array<std::size_t, 3>> triangles_of(const Divided_triangle& division, std::size_t size) {
  std::vector<std::size_t> polygon;
  for (std::size_t i = 0; i < size; ++i) polygon.push_back(i);
  std::vector<std::array<std::size_t, 3>> triangles;
  const auto cut_off = [&](std::size_t place) {
    const std::size_t n = polygon.size();
    triangles.push_back({polygon[(place + n - 1) % n], polygon[place], polygon[(place + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(place));
  };
  for (const std::size_t ear : division.ears())
    cut_off(static_cast<std::size_t>(std::find(polygon.begin(), polygon.end(), ear) - polygon.begin()));
  EXPECT_EQ(polygon.size(), 3u);
  cut_off(1);
  return triangles;
}

}  // namespace

TEST(DividedTriangle, IsDividedAsWellAsCanBeAlongItsChords) {
  std::mt19937 random(1);
  std::size_t chords_held = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Outline outline = random_outline(random, 2);
    const std::size_t size = outline.points.size();
    const std::vector<Chord> chords = random_chords(outline, 4, random);
    const Divided_triangle division(outline.points, chords);
    const auto triangles = triangles_of(division, size);
    ASSERT_EQ(triangles.size(), size - 2);

    std::map<Chord, std::size_t> triangle_on_the_left;
    double quality = 1, least_height = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [i, j, k] = triangles[t];
      const Eigen::Vector3d &a = outline.points[i], &b = outline.points[j], &c = outline.points[k];
      const double doubled_area = (b - a).cross(c - a).norm();
      quality = std::min(quality, relative_height(a, b, c));
      least_height = std::min(least_height, doubled_area / std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}));
      for (const Chord& side : {Chord{i, j}, Chord{j, k}, Chord{k, i}})
        EXPECT_TRUE(triangle_on_the_left.emplace(side, t).second);
    }
    std::vector<std::size_t> polygon;
    for (std::size_t i = 0; i < size; ++i) polygon.push_back(i);
    EXPECT_NEAR(quality, best_quality(outline.points, polygon, chords), 1e-12);
    EXPECT_NEAR(division.least_height(), least_height, 1e-12);

    for (std::size_t i = 0; i < size; ++i)
      EXPECT_EQ(division.triangle_at_side(i), triangle_on_the_left.at({i, (i + 1) % size}));
    for (std::size_t c = 0; c < chords.size(); ++c) {
      const Chord reverse = {chords[c][1], chords[c][0]};
      EXPECT_TRUE(division.is_chord(chords[c][0], chords[c][1]) && division.is_chord(reverse[0], reverse[1]));
      EXPECT_EQ(division.triangles_beside(c),
                (Chord{triangle_on_the_left.at(chords[c]), triangle_on_the_left.at(reverse)}));
    }
    chords_held += chords.size();
    EXPECT_EQ(division.joined_triangles().size() + chords.size(), size - 3);
    for (const auto& [t, u] : division.joined_triangles()) {
      std::set<std::size_t> corners(triangles[t].begin(), triangles[t].end());
      corners.insert(triangles[u].begin(), triangles[u].end());
      EXPECT_EQ(corners.size(), 4u) << "triangles that are joined share a side";
    }
  }
  EXPECT_GT(chords_held, 200u);
}

TEST(DividedTriangle, HasNoHeightWhereChordsCross) {
  std::mt19937 random(2);
  std::size_t crossings = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Outline outline = random_outline(random, 3);
    const std::size_t size = outline.points.size();
    const std::vector<Chord> chords = {{random() % size, random() % size}, {random() % size, random() % size}};
    if (chords[0][0] == chords[0][1] || chords[1][0] == chords[1][1] || !cross(chords[0], chords[1])) continue;
    ++crossings;
    EXPECT_EQ(Divided_triangle(outline.points, chords).least_height(), 0);
  }
  EXPECT_GT(crossings, 20u);
}

}  // namespace test_divided_triangle
