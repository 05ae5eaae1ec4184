# SPDX-License-Identifier: MIT

# cmake -DCPACK=... -DCONFIG=... -DDPKG_DEB=... -DINSTALL_TREE=... -P debian_packages.cmake
# Makes the Debian packages and fails unless they name what they depend on, and hold together what is installed.
cmake_policy(VERSION 3.21)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/debian_packages)
file(REMOVE_RECURSE ${folder})
execute_process(COMMAND ${CPACK} --config ${CONFIG} -B ${folder} COMMAND_ERROR_IS_FATAL ANY)

file(GLOB packages ${folder}/*.deb)
foreach(package IN LISTS packages)
  execute_process(COMMAND ${DPKG_DEB} --field ${package} OUTPUT_VARIABLE fields COMMAND_ERROR_IS_FATAL ANY)
  message("${fields}")
  string(APPEND all_fields "${fields}")
  execute_process(COMMAND ${DPKG_DEB} --extract ${package} ${folder}/tree COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB_RECURSE packed RELATIVE ${folder}/tree/usr ${folder}/tree/usr/*)
set(all_expected "Package: librw-segmentation-dev\n" "libcgal-dev" "libeigen3-dev" "libboost-dev")
if(packed MATCHES "libRW_segmentation_compiled[.]so")
  list(APPEND all_expected "Depends: [^\n]*librw-segmentation[0-9.]+ [(]= ")
endif()
foreach(expected IN LISTS all_expected)
  if(NOT all_fields MATCHES "${expected}")
    message(FATAL_ERROR "No package has: ${expected}")
  endif()
endforeach()

file(GLOB_RECURSE installed RELATIVE ${INSTALL_TREE} ${INSTALL_TREE}/*)
if(NOT packed STREQUAL installed)
  message(FATAL_ERROR "Packed are ${packed}\nand installed ${installed}")
endif()
