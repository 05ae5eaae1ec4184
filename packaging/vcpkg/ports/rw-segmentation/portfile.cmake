# SPDX-License-Identifier: MIT

# The port of the tree that it lies in. Elsewhere, vcpkg_from_github() or vcpkg_from_git() takes the place of this line.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DRW_SEGMENTATION_BUILD_TESTS=OFF
    -DRW_SEGMENTATION_BUILD_EXAMPLES=OFF
    -DRW_SEGMENTATION_BUILD_BENCHMARK=OFF
    -DRW_SEGMENTATION_BUILD_DOC=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME RW_segmentation CONFIG_PATH share/cmake/RW_segmentation)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug")  # headers only
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
