// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_H
#define MESH_FILES_H

// Meshes in files: OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit and VTP in; these and glTF with segments, labels and columns of numbers
// out.
//
// Reading is strict and says where a file is wrong; it allocates no more than a few times the size of the file,
// whatever the header promises. Writing leaves a whole file or none.

#include "mesh_files/Output_file.h"
#include "mesh_files/Polygon_soup.h"
#include "mesh_files/read_mesh.h"
#include "mesh_files/write_mesh.h"

#endif
