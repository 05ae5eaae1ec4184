// SPDX-License-Identifier: MIT

// The module rw_segmentation._core: the library over arrays. What users call is written in Python on top of it.

#include "definitions.h"

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/version.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

NB_MODULE(_core, m) {
  m.doc() = "The library over arrays, as the functions of rw_segmentation call it.";
  const auto part = [](int number) { return std::to_string(number); };
  m.attr("version") = part(RW_SEGMENTATION_VERSION_MAJOR) + "." + part(RW_SEGMENTATION_VERSION_MINOR) + "." +
                      part(RW_SEGMENTATION_VERSION_PATCH);
  nanobind::exception<RW_segmentation::Cancelled>(m, "Cancelled", PyExc_RuntimeError).attr("__doc__") =
      "The progress function of a call has returned False; nothing has changed.";
  rw_python::define_mesh(m);
  rw_python::define_choices(m);
  rw_python::define_hierarchy(m);
  rw_python::define_surfaces(m);
  rw_python::define_walk(m);
  rw_python::define_measures(m);
  rw_python::define_boundaries(m);
  rw_python::define_priors(m);
  rw_python::define_files(m);
}
