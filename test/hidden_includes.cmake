# SPDX-License-Identifier: MIT

# Each program that shares the precompiled header includes what it uses of it, which no compiler sees. What is used is told
# by its name, and counts as included where a header of the project that the program includes by its path does so.

cmake_policy(VERSION 3.21)

set(headers <algorithm> <array> <cmath> <cstddef> <cstdint> <exception> <functional> <iostream> <limits> <map> <optional>
  <string> <utility> <vector> <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h> <CGAL/Simple_cartesian.h>
  <CGAL/Surface_mesh.h> <boost/graph/dijkstra_shortest_paths.hpp> <boost/property_map/function_property_map.hpp>
  <Eigen/Core>)
set(uses_algorithm "std::(sort|any_of|all_of|none_of|find_if|min|max|minmax|fill|transform|count|count_if|reverse|unique)[(<]")
set(uses_array "std::array<")
set(uses_cmath "std::(sqrt|abs|pow|sin|cos|tan|acos|asin|atan2|log|log2|log10|exp|floor|ceil|hypot|isfinite|isnan|round)[(]")
set(uses_cstddef "std::size_t")
set(uses_cstdint "std::u?int(8|16|32|64)_t")
set(uses_exception "std::(exception |current_exception)")
set(uses_functional "std::(function|greater|less|cref|ref)[<(]")
set(uses_iostream "std::(cout|cerr|cin)[^a-z]")
set(uses_limits "std::numeric_limits")
set(uses_map "std::(multi)?map<")
set(uses_optional "std::(optional<|nullopt)")
set(uses_string "std::(string[ &>(,]|to_string|getline|stod|stoul)")
set(uses_utility "std::(pair<|move[(]|swap[(]|exchange[(])")
set(uses_vector "std::vector<")
set(uses_polygon_mesh_io "(Polygon_mesh_processing|PMP)::IO::read_polygon_mesh")
set(uses_Simple_cartesian "CGAL::Simple_cartesian")
set(uses_Surface_mesh "CGAL::Surface_mesh<")
set(uses_dijkstra_shortest_paths "boost::dijkstra_shortest_paths")
set(uses_function_property_map "boost::(make_)?function_property_map")
set(uses_Core "Eigen::(Vector|Matrix|Array|RowVector)")

# What a file of the project includes, and what those of the project do that it includes by their paths.
function(includes_of file result)
  set(all "")
  file(STRINGS ${file} lines REGEX "^#include ")
  cmake_path(GET file PARENT_PATH folder)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include +" "" name "${line}")
    list(APPEND all "${name}")
    if(name MATCHES "^\"(.*)\"$")
      includes_of(${folder}/${CMAKE_MATCH_1} further)
      list(APPEND all ${further})
    endif()
  endforeach()
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

file(STRINGS ${ROOT}/cmake/precompiled_header.h lines REGEX "^#include ")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^#include +" "" name "${line}")
  if(NOT name IN_LIST headers AND NOT name MATCHES "^<Eigen/")
    message(SEND_ERROR "precompiled_header.h hides ${name}: tell here what uses it")
  endif()
endforeach()

file(GLOB programs ${ROOT}/examples/*.cpp ${ROOT}/benchmark/*.cpp ${ROOT}/doc/*.cpp)
foreach(program IN LISTS programs)
  includes_of(${program} includes)
  file(READ ${program} text)
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "^<(.*/)?([A-Za-z_]+)(\\.h|\\.hpp)?>$" "\\2" name "${header}")
    if(text MATCHES "${uses_${name}}" AND NOT header IN_LIST includes
       AND NOT (header STREQUAL "<Eigen/Core>" AND "${includes}" MATCHES "<Eigen/"))
      message(SEND_ERROR "${program} does not include ${header}, but uses ${CMAKE_MATCH_0}")
    endif()
  endforeach()
endforeach()
