// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SRC_FOR_EACH_CONCURRENCY_H
#define RW_SEGMENTATION_SRC_FOR_EACH_CONCURRENCY_H

#include <CGAL/tags.h>

/// Instantiates templates for each concurrency tag that there is.
#ifdef CGAL_LINKED_WITH_TBB
#define RW_SEGMENTATION_FOR_EACH_CONCURRENCY(INSTANTIATE) \
  INSTANTIATE(CGAL::Sequential_tag)                       \
  INSTANTIATE(CGAL::Parallel_tag)
#else
#define RW_SEGMENTATION_FOR_EACH_CONCURRENCY(INSTANTIATE) INSTANTIATE(CGAL::Sequential_tag)
#endif

#endif
