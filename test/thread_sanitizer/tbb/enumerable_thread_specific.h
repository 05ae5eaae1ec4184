// SPDX-License-Identifier: MIT

#include "../tbb_of_threads.h"
