// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_DEFINITIONS_H
#define RW_PYTHON_DEFINITIONS_H

#include <nanobind/nanobind.h>

namespace rw_python {

// What the module is made of, a file each.
void define_mesh(nanobind::module_& m);
void define_choices(nanobind::module_& m);
void define_hierarchy(nanobind::module_& m);
void define_surfaces(nanobind::module_& m);
void define_walk(nanobind::module_& m);
void define_measures(nanobind::module_& m);
void define_boundaries(nanobind::module_& m);
void define_priors(nanobind::module_& m);
void define_files(nanobind::module_& m);

}  // namespace rw_python

#endif
