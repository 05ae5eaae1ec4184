// SPDX-License-Identifier: MIT

// The defaults that the manual's page of parameters tells are those of the headers.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_defaults {

using namespace RW_segmentation;

namespace {

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::istringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) result.push_back(cell);
  return result;
}

using Numbers = std::map<std::string, std::map<std::string, double>>;

/// The numbers in a column, by the heading and the name. Several names may share a row.
Numbers numbers_in_the_manual(std::size_t column) {
  std::ifstream page(MANUAL_PAGE_OF_PARAMETERS);
  Numbers result;
  std::string heading;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) heading = line.substr(3);
    if (line.rfind("| `", 0) != 0) continue;
    std::istringstream names(cells(line).at(0)), numbers(cells(line).at(column));
    for (std::string name, number; names >> name && numbers >> number;) {
      number.erase(std::remove(number.begin(), number.end(), ','), number.end());
      if (number.find_first_not_of("0123456789.e-") != std::string::npos) continue;
      result[heading][name.substr(1, name.rfind('`') - 1)] = std::stod(number);
    }
  }
  return result;
}

/// The largest cost of a merge that a stop allows, of a hundredth, two hundredths, and so on.
template <class Stop>
double largest_cost(const Stop& stop) {
  constexpr std::size_t merges = 300;
  constexpr double costs_of_one = 100;
  std::vector<Merge_tree::Merge> tree = {{0, 1, 1 / costs_of_one}};
  for (std::size_t m = 1; m < merges; ++m)
    tree.push_back({m + 1, merges + m, static_cast<double>(m + 1) / costs_of_one});
  return static_cast<double>(merges + 1 - stop(Merge_tree(merges + 1, std::move(tree)))) / costs_of_one;
}

void expect_told(const Numbers& told, const std::string& heading, const std::string& name, double value) {
  ASSERT_EQ(told.count(heading), 1u) << heading;
  ASSERT_EQ(told.at(heading).count(name), 1u) << heading << ' ' << name;
  EXPECT_EQ(told.at(heading).at(name), value) << heading << ' ' << name;
}

template <class Policies>
void expect_policies_told(const Numbers& told, const Policies& policies) {
  const std::string both = "RW_segmentation::Automatic_segmentation and RW_segmentation::Paper_segmentation";
  const auto expect = [&](const std::string& name, auto value) {
    expect_told(told, both, name, static_cast<double>(value));
  };
  expect("stop", largest_cost(policies.stop));
  expect("smoothing.radius", policies.smoothing.radius);
  expect("difference.convex_weight", policies.difference.convex_weight);
  expect("difference.ordinary_difference", policies.difference.ordinary_difference);
  expect("sigma", policies.sigma);
  expect("cap", policies.cap);
  expect("seedings", policies.seedings);
  expect("seeding.count", policies.seeding.count);
  expect("seeding.sampling", policies.seeding.sampling.normal_weight());
}

}  // namespace

TEST(Defaults, AreThoseThatTheManualTells) {
  const Numbers told = numbers_in_the_manual(1);
  ASSERT_FALSE(told.empty()) << MANUAL_PAGE_OF_PARAMETERS;
  const auto expect = [&](const std::string& heading, const std::string& name, auto value) {
    expect_told(told, heading, name, static_cast<double>(value));
  };

  expect_policies_told(told, Automatic_segmentation());
  expect_policies_told(numbers_in_the_manual(2), Paper_segmentation());

  const Dihedral_difference_policy difference;
  expect("RW_segmentation::Dihedral_difference", "convex_weight", difference.convex_weight);
  expect("RW_segmentation::Dihedral_difference", "ordinary_difference", difference.ordinary_difference);

  expect("RW_segmentation::Surface_segmentation", "stop_cost", Surface_segmentation().stop_cost);

  const Normal_smoothing normals;
  const std::string smoothing = "RW_segmentation::Normal_smoothing";
  expect(smoothing, "radius", normals.radius);
  expect(smoothing, "noise_angle", normals.noise_angle);
  expect(smoothing, "largest_widening", normals.largest_widening);
  expect(smoothing, "heavy_noise", normals.heavy_noise);

  const Walk_reduction reduction;
  expect("RW_segmentation::Walk_reduction", "largest_direct", reduction.largest_direct);
  expect("RW_segmentation::Walk_reduction", "cluster_steps", reduction.cluster_steps);
  expect("RW_segmentation::Walk_reduction", "largest_difference", reduction.largest_difference);
  expect("RW_segmentation::Walk_reduction", "band", reduction.band);

  const Thickness_sampling thickness;
  expect("RW_segmentation::Thickness_sampling", "samples", thickness.samples);
  expect("RW_segmentation::Thickness_sampling", "rays", thickness.rays);
  expect("RW_segmentation::Thickness_sampling", "cone_angle", thickness.cone_angle);

  const Thickness_of_faces diameters;
  expect("RW_segmentation::Thickness_of_faces", "rays", diameters.rays);
  EXPECT_DOUBLE_EQ(diameters.cone_angle, std::acos(-1.) / 3);
  EXPECT_FALSE(diameters.is_smoothed);
  EXPECT_EQ(diameters.scale, Thickness_scale::length);

  const Boundary_smoothing boundaries;
  const std::string curves = "RW_segmentation::Boundary_smoothing";
  expect(curves, "length", boundaries.length);
  expect(curves, "tension", boundaries.tension);
  expect(curves, "feature_weight", boundaries.feature_weight);
  expect(curves, "crease_angle", boundaries.crease_angle);
  expect(curves, "largest_displacement", boundaries.largest_displacement);
  expect(curves, "steps", boundaries.steps);
}

}  // namespace test_defaults
