# SPDX-License-Identifier: MIT

# The target Open_cascade, if Open CASCADE is installed: what boundary_representation.h and the CAD files of segment_mesh
# need. Its own package configuration asks for its viewers as well, and names no include folder.
if(TARGET Open_cascade)
  return()
endif()
find_path(OPEN_CASCADE_INCLUDE_DIR Standard_Version.hxx PATH_SUFFIXES opencascade oce)
set(open_cascade_libraries "")
set(open_cascade_is_whole ${OPEN_CASCADE_INCLUDE_DIR})
foreach(name TKXDESTEP TKSTEP TKXDEIGES TKIGES TKXCAF TKLCAF TKCDF TKXSBase TKTopAlgo TKGeomAlgo TKBRep TKGeomBase TKG3d
    TKG2d TKMath TKernel)
  find_library(OPEN_CASCADE_${name} ${name})
  mark_as_advanced(OPEN_CASCADE_${name})
  list(APPEND open_cascade_libraries ${OPEN_CASCADE_${name}})
  if(NOT OPEN_CASCADE_${name})
    set(open_cascade_is_whole OFF)
  endif()
endforeach()
mark_as_advanced(OPEN_CASCADE_INCLUDE_DIR)
if(open_cascade_is_whole)
  add_library(Open_cascade INTERFACE)
  target_include_directories(Open_cascade SYSTEM INTERFACE ${OPEN_CASCADE_INCLUDE_DIR})
  target_link_libraries(Open_cascade INTERFACE ${open_cascade_libraries})
endif()
