// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_MESH_H
#define MESH_FILES_WRITE_MESH_H

#include "Colors.h"
#include "Segmented_soup.h"
#include "write_3mf.h"
#include "write_columns.h"
#include "write_glb.h"
#include "write_medit.h"
#include "write_msh.h"
#include "write_npz.h"
#include "write_obj.h"
#include "write_off.h"
#include "write_ply.h"
#include "write_stl.h"
#include "write_vtp.h"

#endif
