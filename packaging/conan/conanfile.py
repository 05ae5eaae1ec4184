# SPDX-License-Identifier: MIT

"""Conan 2 recipe of the tree that it lies in: conan create packaging/conan"""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class RwSegmentation(ConanFile):
    name = "rw-segmentation"
    description = "Segmentation of surface meshes with random walks"
    license = "MIT"
    topics = ("mesh", "segmentation", "cgal", "geometry-processing")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    @property
    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._tree, "include", "RW_segmentation", "version.h"))
        self.version = ".".join(
            re.search(rf"#define RW_SEGMENTATION_VERSION_{part} (\d+)", header).group(1)
            for part in ("MAJOR", "MINOR", "PATCH"))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "cmake/*", "examples/*", "include/*", "src/*"):
            copy(self, pattern, self._tree, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("cgal/[>=5.5]", transitive_headers=True)
        self.requires("eigen/[>=3.4 <4]", transitive_headers=True)
        self.requires("boost/[>=1.72]", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 17)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part in ("TESTS", "EXAMPLES", "BENCHMARK", "DOC"):
            toolchain.variables[f"RW_SEGMENTATION_BUILD_{part}"] = False
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        CMake(self).install()

    def package_id(self):
        self.info.clear()

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "RW_segmentation")
        self.cpp_info.set_property("cmake_target_name", "RW_segmentation::RW_segmentation")
        self.cpp_info.set_property("pkg_config_name", "RW_segmentation")
        self.cpp_info.requires = ["cgal::cgal", "eigen::eigen", "boost::headers"]
