// SPDX-License-Identifier: MIT

// Carries the precompiled header that the tests share, and that which the fuzz targets do.
