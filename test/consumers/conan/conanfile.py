# SPDX-License-Identifier: MIT

"""CGAL, Eigen or Boost of this machine as a Conan package, for tests without a server of packages."""

from conan import ConanFile

NAMES_IN_CMAKE = {
    "cgal": ("CGAL", "CGAL::CGAL"),
    "eigen": ("Eigen3", "Eigen3::Eigen"),
    "boost": ("Boost", "Boost::headers"),
}


class LibraryOfThisMachine(ConanFile):
    """An empty package: find_package() finds what is installed."""

    package_type = "header-library"

    def package_info(self):
        file_name, target_name = NAMES_IN_CMAKE[self.name]
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.set_property("cmake_file_name", file_name)
        headers = self.cpp_info.components["headers"] if self.name == "boost" else self.cpp_info
        headers.set_property("cmake_target_name", target_name)
        headers.includedirs = []
