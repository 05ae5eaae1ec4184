// SPDX-License-Identifier: MIT

// What most examples and benchmark programs include and what takes long to parse. A program includes what it uses all the
// same, which test/hidden_includes.cmake sees to.
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What most examples read their mesh with is compiled once, in precompiled_header.cpp.
extern template bool CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(
    const std::string&, CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>&,
    const CGAL::parameters::Default_named_parameters&);
