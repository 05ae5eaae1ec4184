# SPDX-License-Identifier: MIT

"""Conan 2 recipe of the tree that it lies in: conan create packaging/conan."""

import re
import shutil
from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class RwSegmentation(ConanFile):
    """The headers and, with the option `compiled`, the library of their part without templates."""

    name = "rw-segmentation"
    description = "Segmentation of surface meshes with random walks"
    license = "MIT"
    topics = ("mesh", "segmentation", "cgal", "geometry-processing")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"compiled": [True, False], "shared": [True, False], "fPIC": [True, False]}
    default_options = {"compiled": False, "shared": False, "fPIC": True}
    no_copy_source = True

    @property
    def _tree(self):
        return Path(self.recipe_folder).parent.parent

    def set_version(self):
        header = load(self, self._tree / "include" / "RW_segmentation" / "version.h")
        self.version = ".".join(
            re.search(rf"#define RW_SEGMENTATION_VERSION_{part} (\d+)", header).group(1)
            for part in ("MAJOR", "MINOR", "PATCH")
        )

    def export_sources(self):
        to = Path(self.export_sources_folder)
        for file in ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md"):
            shutil.copy(self._tree / file, to)
        # Folder by folder: copy() looks through all that lies below, and beside them may lie large folders of builds.
        for folder in ("cmake", "examples", "include", "src"):
            copy(self, "*", str(self._tree / folder), str(to / folder), excludes="*/node_modules")

    def config_options(self):
        if self.settings.os == "Windows":
            self.options.rm_safe("fPIC")

    def configure(self):
        if not self.options.compiled:
            self.package_type = "header-library"
            self.options.rm_safe("shared")
            self.options.rm_safe("fPIC")
        elif self.options.shared:
            self.options.rm_safe("fPIC")

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        # Programs link the libraries that CGAL's headers use, GMP and MPFR, even where ours is shared.
        self.requires("cgal/[>=5.5]", transitive_headers=True, transitive_libs=True)
        self.requires("eigen/[>=3.4 <4]", transitive_headers=True)
        self.requires("boost/[>=1.72]", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 17)
        if self.settings.os == "Windows" and self.options.get_safe("shared"):
            raise ConanInvalidConfiguration("a DLL would export nothing: on Windows the library is static")

    def generate(self):
        dependencies = CMakeDeps(self)
        # CGAL says itself that later major versions will do, and CMakeDeps that they will not.
        dependencies.set_property("cgal", "cmake_config_version_compat", "AnyNewerVersion")
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        for part in ("TESTS", "EXAMPLES", "BENCHMARK", "DOC"):
            toolchain.variables[f"RW_SEGMENTATION_BUILD_{part}"] = False
        toolchain.variables["RW_SEGMENTATION_COMPILED"] = bool(self.options.compiled)
        # The package does not require TBB, so it must not use one that happens to be installed.
        toolchain.variables["CMAKE_DISABLE_FIND_PACKAGE_TBB"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        package = Path(self.package_folder)
        copy(self, "LICENSE", self.source_folder, str(package / "licenses"))
        # What package_info() says takes the place of these.
        for folder in ("lib", "share"):
            rmdir(self, package / folder / "cmake")
            rmdir(self, package / folder / "pkgconfig")

    def package_id(self):
        if not self.info.options.compiled:
            self.info.clear()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "RW_segmentation")
        headers = self.cpp_info.components["headers"]
        headers.set_property("cmake_target_name", "RW_segmentation::RW_segmentation")
        headers.set_property("pkg_config_name", "RW_segmentation")
        headers.bindirs = []
        headers.libdirs = []
        headers.requires = ["cgal::cgal", "eigen::eigen", "boost::headers"]
        if self.settings.compiler == "gcc":
            headers.cxxflags = ["-frounding-math"]  # for CGAL's interval arithmetic, where CMake does not add it
        if self.options.compiled:
            compiled = self.cpp_info.components["compiled"]
            compiled.set_property("cmake_target_name", "RW_segmentation::compiled")
            compiled.set_property("pkg_config_name", "RW_segmentation_compiled")
            compiled.defines = ["RW_SEGMENTATION_COMPILED"]
            compiled.libs = ["RW_segmentation_compiled"]
            compiled.requires = ["headers"]
