#include <doctest/doctest.h>

#include "gpu/gpu_rig.h"
