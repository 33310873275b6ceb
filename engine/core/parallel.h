#pragma once
#include <cstddef>

#include "core/function_ref.h"

namespace vasa {

/// How many threads parallel loops may use; 0 means one per core. Results never depend on it.
void setThreadCount(unsigned count);
unsigned threadCount();

/// Calls body(i) for every i in [0, count), in any order and on any thread; the calling thread works
/// too. Exceptions leave through here, Cancelled (core/cancellation.h) before any i. body must write only to
/// places that belong to i.
/// @param grain  iterations that are worth handing to another thread
void parallelFor(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t)> body);

/// From now on the calling thread, and the workers that take part in its parallel loops, let threads of the
/// usual priority go first, yet never stand still for them (nice 10: a tenth of their share). For what is
/// made beside a picture that the same processors draw: a driver's thread that waits for a turn keeps all
/// others of its stage waiting. Lasts as long as the threads do. Does nothing elsewhere than on Linux.
void giveWay();

}  // namespace vasa
