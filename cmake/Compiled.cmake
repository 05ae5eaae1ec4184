# SPDX-License-Identifier: MIT

# The target RW_segmentation::compiled: what the library does that depends on no type of the user's, in one place instead
# of in each program. Static or shared, by BUILD_SHARED_LIBS. Its parallel parts use TBB where that is found.
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*.cpp)
set(type_of_library "")
if(RW_SEGMENTATION_INSTALL AND NOT RW_SEGMENTATION_COMPILED)
  set(type_of_library STATIC)  # the tool is installed without it then
endif()
add_library(RW_segmentation_compiled ${type_of_library} ${sources})
add_library(RW_segmentation::compiled ALIAS RW_segmentation_compiled)
set_target_properties(RW_segmentation_compiled PROPERTIES EXPORT_NAME compiled
  # Four files as two, which take about as long as each other: what takes long to parse is parsed once for both.
  UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 2
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(NOT DEFINED CMAKE_POSITION_INDEPENDENT_CODE)  # shared libraries may link it
  set_target_properties(RW_segmentation_compiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
endif()
target_link_libraries(RW_segmentation_compiled PUBLIC RW_segmentation)
target_compile_definitions(RW_segmentation_compiled PUBLIC RW_SEGMENTATION_COMPILED)
set(RW_SEGMENTATION_COMPILED_OPTIONS "" CACHE STRING "Options of the compiler for RW_segmentation::compiled alone")
target_compile_options(RW_segmentation_compiled PRIVATE ${RW_SEGMENTATION_COMPILED_OPTIONS})
if(BUILD_SHARED_LIBS AND UNIX AND NOT APPLE)
  # It exports its own names alone, of a version, and calls its own functions, however a program compiled the same ones.
  configure_file(${PROJECT_SOURCE_DIR}/cmake/RW_segmentation.map.in ${PROJECT_BINARY_DIR}/RW_segmentation.map @ONLY)
  target_link_options(RW_segmentation_compiled PRIVATE
    LINKER:-Bsymbolic-functions,--version-script=${PROJECT_BINARY_DIR}/RW_segmentation.map)
endif()
if(NOT RW_SEGMENTATION_COMPILED)
  set_target_properties(RW_segmentation_compiled PROPERTIES EXCLUDE_FROM_ALL ON)
endif()

find_package(TBB QUIET CONFIG)
if(TBB_FOUND)
  include(CGAL_TBB_support)
endif()
set(RW_SEGMENTATION_COMPILED_WITH_TBB OFF)
if(TARGET CGAL::TBB_support)
  set(RW_SEGMENTATION_COMPILED_WITH_TBB ON)
  target_link_libraries(RW_segmentation_compiled PUBLIC CGAL::TBB_support)
endif()
