// The defaults that the manual's page of parameters tells are those of the headers.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Engineering_segmentation.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace RW_segmentation;

namespace {

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::istringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) result.push_back(cell);
  return result;
}

/// The numbers in the column of defaults, by the heading and the name. Several names may share a row.
std::map<std::string, std::map<std::string, double>> defaults_in_the_manual() {
  std::ifstream page(MANUAL_PAGE_OF_PARAMETERS);
  std::map<std::string, std::map<std::string, double>> defaults;
  std::string heading;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) heading = line.substr(3);
    if (line.rfind("| `", 0) != 0) continue;
    std::istringstream names(cells(line).at(0)), numbers(cells(line).at(1));
    for (std::string name, number; names >> name && numbers >> number;) {
      number.erase(std::remove(number.begin(), number.end(), ','), number.end());
      if (number.find_first_not_of("0123456789.e-") != std::string::npos) continue;
      defaults[heading][name.substr(1, name.rfind('`') - 1)] = std::stod(number);
    }
  }
  return defaults;
}

}  // namespace

TEST(Defaults, AreThoseThatTheManualTells) {
  const auto told = defaults_in_the_manual();
  ASSERT_FALSE(told.empty()) << MANUAL_PAGE_OF_PARAMETERS;
  const auto expect = [&](const std::string& heading, const std::string& name, auto value) {
    ASSERT_EQ(told.count(heading), 1u) << heading;
    ASSERT_EQ(told.at(heading).count(name), 1u) << heading << ' ' << name;
    EXPECT_EQ(told.at(heading).at(name), static_cast<double>(value)) << heading << ' ' << name;
  };

  const Automatic_segmentation automatic;
  const std::string both = "RW_segmentation::Automatic_segmentation and RW_segmentation::Paper_segmentation";
  expect(both, "stop_cost", automatic.stop_cost);
  expect(both, "convex_weight", automatic.convex_weight);
  expect(both, "ordinary_difference", automatic.ordinary_difference);
  expect(both, "sigma", automatic.sigma);
  expect(both, "cap", automatic.cap);
  expect(both, "seeds", automatic.seeds);
  expect(both, "sampling", automatic.sampling.normal_weight());

  const Engineering_segmentation engineering;
  const std::string parts = "RW_segmentation::Engineering_segmentation";
  expect(parts, "stop_cost", engineering.stop_cost);
  expect(parts, "convex_weight", engineering.convex_weight);
  expect(parts, "sigma", engineering.sigma);
  expect(parts, "cap", engineering.cap);

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

  const Boundary_smoothing boundaries;
  const std::string curves = "RW_segmentation::Boundary_smoothing";
  expect(curves, "length", boundaries.length);
  expect(curves, "tension", boundaries.tension);
  expect(curves, "feature_weight", boundaries.feature_weight);
  expect(curves, "crease_angle", boundaries.crease_angle);
  expect(curves, "largest_displacement", boundaries.largest_displacement);
  expect(curves, "steps", boundaries.steps);
}
