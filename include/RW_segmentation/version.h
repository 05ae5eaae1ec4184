// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_VERSION_H
#define RW_SEGMENTATION_VERSION_H

// The one place where the version stands: CMakeLists.txt reads the first three numbers.
/// Changes where programs that use the library may have to.
#define RW_SEGMENTATION_VERSION_MAJOR 0
/// Changes with new features; below 1.0, where programs may have to change.
#define RW_SEGMENTATION_VERSION_MINOR 1
/// Changes with mended faults.
#define RW_SEGMENTATION_VERSION_PATCH 0

/// The version as one number for preprocessor conditions: 10203 for version 1.2.3.
#define RW_SEGMENTATION_VERSION \
  (RW_SEGMENTATION_VERSION_MAJOR * 10000 + RW_SEGMENTATION_VERSION_MINOR * 100 + RW_SEGMENTATION_VERSION_PATCH)

#endif  // RW_SEGMENTATION_VERSION_H
