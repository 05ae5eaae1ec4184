# SPDX-License-Identifier: MIT

# The port of the tree that it lies in. Elsewhere, vcpkg_from_github() or vcpkg_from_git() takes the place of this line.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS FEATURES compiled RW_SEGMENTATION_COMPILED)
if(RW_SEGMENTATION_COMPILED)
  if(VCPKG_TARGET_IS_WINDOWS)
    vcpkg_check_linkage(ONLY_STATIC_LIBRARY)  # a DLL would export nothing
  endif()
  # The port does not require TBB, so it must not use one that happens to be installed.
  list(APPEND FEATURE_OPTIONS -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON)
  set(config_path lib/cmake/RW_segmentation)
else()
  set(config_path share/cmake/RW_segmentation)
endif()

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DRW_SEGMENTATION_BUILD_TESTS=OFF
    -DRW_SEGMENTATION_BUILD_EXAMPLES=OFF
    -DRW_SEGMENTATION_BUILD_BENCHMARK=OFF
    -DRW_SEGMENTATION_BUILD_DOC=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME RW_segmentation CONFIG_PATH ${config_path})
vcpkg_fixup_pkgconfig()

if(RW_SEGMENTATION_COMPILED)
  file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
else()
  file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug")  # headers only
endif()
file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
