# SPDX-License-Identifier: MIT

# Debian packages by cpack, one for each component that has something to install.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The RW_segmentation authors")
set(CPACK_PACKAGE_CONTACT "The RW_segmentation authors <maintainers@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME librw-segmentation-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
if(NOT RW_SEGMENTATION_COMPILED)
  set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.4), libboost-dev (>= 1.72)")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Segmentation of surface meshes with random walks: headers and examples")

# There is one if the library is compiled and shared.
set(CPACK_DEBIAN_LIB_PACKAGE_NAME librw-segmentation${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIB_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIB_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_LIB_DESCRIPTION "Segmentation of surface meshes with random walks: the shared library")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME segment-mesh)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)
if(RW_SEGMENTATION_COMPILED AND BUILD_SHARED_LIBS)
  # dpkg-shlibdeps knows nothing of a package that is being made.
  set(library_package "${CPACK_DEBIAN_LIB_PACKAGE_NAME} (= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
  set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "${library_package}")
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", ${library_package}")
endif()
set(CPACK_COMPONENT_TOOL_DESCRIPTION "Segmentation of surface meshes with random walks: the program segment_mesh")

# A single component is one package of no name of its own to CPack unless it is told.
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
include(CPack)
