// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_COMPILED_H
#define RW_SEGMENTATION_INTERNAL_COMPILED_H

/// What depends on no type of the user's stands in `internal/definitions`. It is compiled with every program, or, where
/// `RW_SEGMENTATION_COMPILED` is defined, once: in the library `RW_segmentation_compiled`.
#ifdef RW_SEGMENTATION_COMPILED
#define RW_SEGMENTATION_INLINE
#else
#define RW_SEGMENTATION_INLINE inline
#endif

#endif
