// SPDX-License-Identifier: MIT

#include <RW_segmentation/version.h>

#include <CGAL/version.h>

#include <gtest/gtest.h>

#include <string>

namespace test_version {

TEST(Version, of_the_package_is_that_of_the_header) {
  const std::string version = std::to_string(RW_SEGMENTATION_VERSION_MAJOR) + "." +
                              std::to_string(RW_SEGMENTATION_VERSION_MINOR) + "." +
                              std::to_string(RW_SEGMENTATION_VERSION_PATCH);
  EXPECT_EQ(version, PACKAGE_VERSION);
}

TEST(Version, of_the_package_is_that_of_the_vcpkg_port) { EXPECT_STREQ(PACKAGE_VERSION, VCPKG_VERSION); }

// Headers of another CGAL on the include path would make a run with CGAL 6 a second run with CGAL 5.
TEST(Version, of_CGAL_is_the_one_that_was_asked_for) { EXPECT_STREQ(CGAL_VERSION_STR, FOUND_CGAL_VERSION); }

}  // namespace test_version
