# SPDX-License-Identifier: MIT

"""Builds and runs a program with each target of the package; conan create does so after it has made one."""

from pathlib import Path

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout


class TestPackage(ConanFile):
    """A user of the package."""

    settings = "os", "arch", "compiler", "build_type"

    @property
    def _is_compiled(self):
        return bool(self.dependencies["rw-segmentation"].options.compiled)

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False  # it would lie in the source folder
        toolchain.variables["COMPILED"] = self._is_compiled
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        if not can_run(self):
            return
        programs = ["segment_cube"]
        if self._is_compiled:
            programs.append("segment_cube_compiled")
        for program in programs:
            self.run(str(Path(self.build_folder, self.cpp.build.bindir, program)), env="conanrun")
