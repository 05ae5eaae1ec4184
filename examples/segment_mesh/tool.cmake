# SPDX-License-Identifier: MIT

# The tool segment_mesh, of three parts: what it does, what writes CAD files, and how it is told what to do. Each is compiled
# as one, since what takes long to parse and to instantiate is so once then. What takes longest stands first, as it is begun
# first.
foreach(target IN ITEMS CLI11::CLI11 nlohmann_json::nlohmann_json)
  if(NOT TARGET ${target})
    message(STATUS "The tool segment_mesh: left out, it needs ${target}")
    return()
  endif()
endforeach()

add_library(segment_mesh_work OBJECT segment_mesh/Boundaries.cpp segment_mesh/Closest_face.cpp
  segment_mesh/Oriented_mesh.cpp segment_mesh/Output_files.cpp segment_mesh/Segmentation.cpp segment_mesh/close_parts.cpp
  segment_mesh/read_input.cpp)
set_target_properties(segment_mesh_work PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
target_link_libraries(segment_mesh_work PUBLIC RW_segmentation_development CLI11::CLI11 nlohmann_json::nlohmann_json
  $<TARGET_NAME_IF_EXISTS:RW_segmentation_compiled>)
if(COMMAND use_precompiled_header)  # installed, the examples do without
  use_precompiled_header(segment_mesh_work)
endif()

# Formats that the tool does not read by itself.
if(TARGET assimp::assimp)
  target_link_libraries(segment_mesh_work PUBLIC assimp::assimp)
  target_compile_definitions(segment_mesh_work PUBLIC RW_SEGMENTATION_WITH_ASSIMP)
endif()

# One file writes CAD files, where Open CASCADE is. It is a library that the tool loads when such a file is asked for, since
# Open CASCADE takes nine times as long to load as the tool takes to start without it.
if(TARGET Open_cascade)
  add_library(cad_shape OBJECT segment_mesh/Cad_shape.cpp)
  set_target_properties(cad_shape PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(cad_shape PUBLIC Open_cascade RW_segmentation_development nlohmann_json::nlohmann_json
    $<TARGET_NAME_IF_EXISTS:RW_segmentation_compiled>)
  add_library(segment_mesh_cad MODULE $<TARGET_OBJECTS:cad_shape>)
  set_target_properties(segment_mesh_cad PROPERTIES PREFIX "" LINKER_LANGUAGE CXX)
  target_link_libraries(segment_mesh_cad PRIVATE cad_shape)
  target_compile_definitions(segment_mesh_work PUBLIC
    SEGMENT_MESH_CAD_LIBRARY="$<TARGET_FILE_NAME:segment_mesh_cad>")
  target_link_libraries(segment_mesh_work PUBLIC ${CMAKE_DL_LIBS})
endif()

# With less optimisation this compiles in two thirds of the time.
add_executable(segment_mesh segment_mesh.cpp segment_mesh/tiles/run_tiles.cpp segment_mesh/read_by_assimp.cpp)
# What it includes, nothing else does.
set_source_files_properties(segment_mesh/read_by_assimp.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
set_target_properties(segment_mesh PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
target_link_libraries(segment_mesh PRIVATE segment_mesh_work)
if(COMMAND use_precompiled_header)
  use_precompiled_header(segment_mesh)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(segment_mesh PRIVATE $<$<CONFIG:Release>:-O1>)
endif()
set(library_folders "")  # seen from where the tool is installed
if(BUILD_SHARED_LIBS)
  list(APPEND library_folders "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()
if(TARGET segment_mesh_cad)
  add_dependencies(segment_mesh segment_mesh_cad)
  set(cad_library_dir ${CMAKE_INSTALL_LIBDIR}/RW_segmentation)
  list(APPEND library_folders "$ORIGIN/../${cad_library_dir}")
  set_target_properties(segment_mesh PROPERTIES BUILD_RPATH "$ORIGIN")
endif()
set_target_properties(segment_mesh PROPERTIES INSTALL_RPATH "${library_folders}")

# The page that `segment_mesh --html` fills in, once it is built, see browser/README.md.
if(NOT CMAKE_SOURCE_DIR STREQUAL CMAKE_CURRENT_SOURCE_DIR)
  set(page ${PROJECT_SOURCE_DIR}/build/browser/page/index.html)
  target_compile_definitions(segment_mesh_work PUBLIC SEGMENT_MESH_PAGE="${page}")
endif()

if(RW_SEGMENTATION_INSTALL)
  install(FILES ${page} OPTIONAL COMPONENT tool
    DESTINATION ${CMAKE_INSTALL_DATADIR}/RW_segmentation RENAME segment_mesh.html)
  # The manual page of the tool is what the tool says of itself.
  add_custom_command(TARGET segment_mesh POST_BUILD
    COMMAND segment_mesh --man > ${CMAKE_CURRENT_BINARY_DIR}/segment_mesh.1 VERBATIM)
  install(TARGETS segment_mesh OPTIONAL COMPONENT tool)
  if(TARGET segment_mesh_cad)
    install(TARGETS segment_mesh_cad OPTIONAL LIBRARY DESTINATION ${cad_library_dir} COMPONENT tool)
  endif()
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/segment_mesh.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL
    COMPONENT tool)
endif()
