# SPDX-License-Identifier: MIT

# The target RW_segmentation_development: the library as our own tests, examples and benchmarks compile it, with
# warnings as errors, the optional libraries that are found, and CGAL's data meshes.

add_library(RW_segmentation_development INTERFACE)
target_link_libraries(RW_segmentation_development INTERFACE RW_segmentation::RW_segmentation)
option(RW_SEGMENTATION_WARNINGS_AS_ERRORS "Stop at a compiler warning" ON)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(RW_segmentation_development INTERFACE -Wall -Wextra -Wpedantic -Wconversion
    $<$<BOOL:${RW_SEGMENTATION_WARNINGS_AS_ERRORS}>:-Werror>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC errs about these in optimised code of CGAL and Eigen.
  target_compile_options(RW_segmentation_development INTERFACE -Wno-error=maybe-uninitialized)
  # It collects its garbage from so many kilobytes on, in place of 128 MB: files of segment_mesh and of the tests take .85 of
  # the time then, and up to a third more memory.
  target_compile_options(RW_segmentation_development INTERFACE --param=ggc-min-heapsize=1500000)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # GoogleTest's typed test suites use such macros.
  target_compile_options(RW_segmentation_development INTERFACE -Wno-gnu-zero-variadic-macro-arguments)
  # LLD links the tests under sanitizers in a seventh of the time that GNU ld takes.
  find_program(LLD ld.lld)
  mark_as_advanced(LLD)
  if(LLD AND NOT APPLE)
    target_link_options(RW_segmentation_development INTERFACE -fuse-ld=lld)
  endif()
endif()

target_compile_options(RW_segmentation_compiled PRIVATE
  $<TARGET_PROPERTY:RW_segmentation_development,INTERFACE_COMPILE_OPTIONS>)

# ccache, where it is installed; in CI it would find nothing. The settings let it work with precompiled headers.
find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER AND NOT DEFINED ENV{CI})
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(RW_segmentation_development INTERFACE -fpch-preprocess)
  else()
    target_compile_options(RW_segmentation_development INTERFACE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
endif()

# Optional libraries. Code asks for them by RW_SEGMENTATION_WITH_<NAME>, parallel parts of CGAL by CGAL_LINKED_WITH_TBB.
function(use_optional_library name target)
  if(TARGET ${target})
    message(STATUS "Optional library ${name}: found")
    target_link_libraries(RW_segmentation_development INTERFACE ${target})
    target_compile_definitions(RW_segmentation_development INTERFACE RW_SEGMENTATION_WITH_${name})
  else()
    message(STATUS "Optional library ${name}: not found, what needs it is left out")
  endif()
endfunction()

find_package(OpenMesh QUIET CONFIG)
find_package(CLI11 QUIET CONFIG)
find_package(nlohmann_json QUIET CONFIG)
find_package(ZLIB QUIET)
find_package(assimp QUIET CONFIG)  # of the tool and one benchmark alone
if(TARGET assimp::assimp)
  message(STATUS "Optional library ASSIMP: found")
else()
  message(STATUS "Optional library ASSIMP: not found, segment_mesh reads fewer formats")
endif()
include(${PROJECT_SOURCE_DIR}/examples/segment_mesh/Open_cascade.cmake)

find_package(CHOLMOD QUIET CONFIG)  # shipped with SuiteSparse since version 7
if(NOT TARGET SuiteSparse::CHOLMOD)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
  if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY)
    add_library(SuiteSparse::CHOLMOD UNKNOWN IMPORTED)
    set_target_properties(SuiteSparse::CHOLMOD PROPERTIES
      IMPORTED_LOCATION ${CHOLMOD_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CHOLMOD_INCLUDE_DIR})
  endif()
endif()

use_optional_library(OPENMESH OpenMeshCore)
use_optional_library(CHOLMOD SuiteSparse::CHOLMOD)
use_optional_library(TBB CGAL::TBB_support)
use_optional_library(CLI11 CLI11::CLI11)
use_optional_library(NLOHMANN_JSON nlohmann_json::nlohmann_json)
use_optional_library(ZLIB ZLIB::ZLIB)

# Open CASCADE is linked by those alone that need it.
if(TARGET Open_cascade)
  message(STATUS "Optional library OPEN_CASCADE: found")
else()
  message(STATUS "Optional library OPEN_CASCADE: not found, what needs it is left out")
endif()

# The folder `data` of CGAL, with the meshes: given by the user, or unpacked from the archive in Debian's libcgal-demo.
set(RW_SEGMENTATION_DATA_DIR "" CACHE PATH
  "CGAL's data folder, which holds the folder meshes; empty: unpack libcgal-demo's archive")
set(data_dir ${RW_SEGMENTATION_DATA_DIR})
if(NOT data_dir)
  find_file(RW_SEGMENTATION_DATA_ARCHIVE NAMES data.tar.gz data.tar.xz data.tar
    PATHS /usr/share/doc/libcgal-demo NO_DEFAULT_PATH DOC "The archive of CGAL's data folder")
  if(RW_SEGMENTATION_DATA_ARCHIVE)
    set(data_dir ${PROJECT_BINARY_DIR}/data)
    if(NOT EXISTS ${data_dir}/meshes)
      message(STATUS "Unpacking ${RW_SEGMENTATION_DATA_ARCHIVE}")
      file(ARCHIVE_EXTRACT INPUT ${RW_SEGMENTATION_DATA_ARCHIVE} DESTINATION ${PROJECT_BINARY_DIR})
    endif()
  endif()
endif()
if(data_dir)
  target_compile_definitions(RW_segmentation_development INTERFACE RW_SEGMENTATION_DATA_DIR="${data_dir}")
else()
  message(STATUS "CGAL's data meshes: not found, tests on them are skipped. "
    "Install libcgal-demo or give RW_SEGMENTATION_DATA_DIR.")
endif()

# One precompiled header for examples and benchmark programs, and what they share. Where they are few, as in
# scripts/quickstart, it takes longer than it saves.
if(RW_SEGMENTATION_BUILD_BENCHMARK OR RW_SEGMENTATION_BUILD_TESTS)
  add_library(program_precompiled_header STATIC EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/cmake/precompiled_header.cpp)
  target_link_libraries(program_precompiled_header PRIVATE RW_segmentation_development)
  target_precompile_headers(program_precompiled_header PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled_header.h)
endif()
function(use_precompiled_header program)
  if(TARGET program_precompiled_header)
    target_precompile_headers(${program} REUSE_FROM program_precompiled_header)
    target_link_libraries(${program} PRIVATE program_precompiled_header)
  endif()
endfunction()
