#pragma once
#include "core/function_ref.h"

namespace vasa {

/// Does work on the calling thread, and lets the parallel loops in it (core/parallel.h) take up nothing but
/// their own rounds meanwhile. For what is done once under a lock: a thread that waits at such a loop's end
/// could else begin a round of the loop around it, and wait for the very lock that it holds.
void isolated(FunctionRef<void()> work);

}  // namespace vasa
