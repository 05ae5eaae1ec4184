# SPDX-License-Identifier: MIT

# Install rules, a package configuration for find_package(RW_segmentation) that serves the install tree and the build
# tree alike, and a file for pkg-config. The component `dev` is the library; the tool segment_mesh is the component `tool`,
# see examples/CMakeLists.txt.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)

# Headers alone lie in the same place on every architecture.
set(package_root ${CMAKE_INSTALL_DATADIR})
set(any_architecture ARCH_INDEPENDENT)
set(package_needs_TBB OFF)
if(RW_SEGMENTATION_COMPILED)
  set(package_needs_TBB ${RW_SEGMENTATION_COMPILED_WITH_TBB})
  set(package_root ${CMAKE_INSTALL_LIBDIR})
  set(any_architecture "")
  install(TARGETS RW_segmentation_compiled EXPORT RW_segmentationTargets
    ARCHIVE COMPONENT dev LIBRARY COMPONENT lib NAMELINK_COMPONENT dev RUNTIME COMPONENT lib)
endif()
set(package_dir ${package_root}/cmake/RW_segmentation)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/RW_segmentation DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(TARGETS RW_segmentation EXPORT RW_segmentationTargets)
install(EXPORT RW_segmentationTargets NAMESPACE RW_segmentation:: DESTINATION ${package_dir})
export(EXPORT RW_segmentationTargets NAMESPACE RW_segmentation::
  FILE ${PROJECT_BINARY_DIR}/RW_segmentationTargets.cmake)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/RW_segmentationConfig.cmake.in
  ${PROJECT_BINARY_DIR}/RW_segmentationConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
# Below 1.0 a new minor version may break the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/RW_segmentationConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ${any_architecture})
install(FILES
  ${PROJECT_BINARY_DIR}/RW_segmentationConfig.cmake ${PROJECT_BINARY_DIR}/RW_segmentationConfigVersion.cmake
  DESTINATION ${package_dir})

set(pkgconfig_dir ${package_root}/pkgconfig)
file(RELATIVE_PATH prefix_from_pkgconfig /prefix/${pkgconfig_dir} /prefix/)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})
configure_file(${PROJECT_SOURCE_DIR}/cmake/RW_segmentation.pc.in ${PROJECT_BINARY_DIR}/RW_segmentation.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/RW_segmentation.pc DESTINATION ${pkgconfig_dir})
if(RW_SEGMENTATION_COMPILED)
  set(parallel_flags "")
  set(parallel_libraries "")
  if(package_needs_TBB)
    set(parallel_flags " -DCGAL_LINKED_WITH_TBB")
    set(parallel_libraries " tbb")
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/RW_segmentation_compiled.pc.in
    ${PROJECT_BINARY_DIR}/RW_segmentation_compiled.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/RW_segmentation_compiled.pc DESTINATION ${pkgconfig_dir})
endif()

# A project of its own that builds against the installed library. Not among the documentation, which slim systems leave
# out.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/RW_segmentation
  PATTERN "tests*" EXCLUDE PATTERN "run_and_compare.cmake" EXCLUDE PATTERN "node_modules" EXCLUDE)
