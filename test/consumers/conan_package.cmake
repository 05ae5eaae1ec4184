# SPDX-License-Identifier: MIT

# cmake -DCONAN=... -DRECIPE=... -DCGAL=VERSION -DEIGEN=VERSION -DBOOST=VERSION -DCGAL_DIR=... -DCXX_COMPILER=...
#   -P conan_package.cmake
# Makes the Conan package, of headers alone, and the program that tests it, with the libraries of this machine.
cmake_policy(VERSION 3.21)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/conan_package)
file(REMOVE_RECURSE ${folder})
set(ENV{CONAN_HOME} ${folder}/home)
set(ENV{CXX} ${CXX_COMPILER})

function(conan)
  execute_process(COMMAND ${CONAN} ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

conan(profile detect)
foreach(library CGAL EIGEN BOOST)
  string(TOLOWER ${library} name)
  conan(export ${CMAKE_CURRENT_LIST_DIR}/conan --name ${name} --version ${${library}})
endforeach()
string(CONCAT variables "'CMAKE_CXX_FLAGS_DEBUG': '-O0', 'CGAL_DIR': '${CGAL_DIR}', "
  "'CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE': 'ON'")
conan(create ${RECIPE} --no-remote --build=missing -s build_type=Debug -s compiler.cppstd=17
  -c tools.cmake.cmake_layout:test_folder=${folder}/test_package
  -c "tools.cmake.cmaketoolchain:extra_variables={${variables}}")
