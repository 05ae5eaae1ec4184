#ifndef RW_SEGMENTATION_VERSION_H
#define RW_SEGMENTATION_VERSION_H

// The one place where the version stands: CMakeLists.txt reads these three lines.
#define RW_SEGMENTATION_VERSION_MAJOR 0
#define RW_SEGMENTATION_VERSION_MINOR 1
#define RW_SEGMENTATION_VERSION_PATCH 0

/// The version as one number for preprocessor conditions: 10203 for version 1.2.3.
#define RW_SEGMENTATION_VERSION \
  (RW_SEGMENTATION_VERSION_MAJOR * 10000 + RW_SEGMENTATION_VERSION_MINOR * 100 + RW_SEGMENTATION_VERSION_PATCH)

#endif  // RW_SEGMENTATION_VERSION_H
