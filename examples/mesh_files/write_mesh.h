// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_MESH_H
#define MESH_FILES_WRITE_MESH_H

#include "Colors.h"
#include "write_columns.h"
#include "write_obj.h"
#include "write_off.h"
#include "write_ply.h"

#endif
