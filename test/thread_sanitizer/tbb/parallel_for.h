#include "../tbb_of_threads.h"
