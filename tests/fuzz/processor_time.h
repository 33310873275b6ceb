#pragma once
#include <time.h>

namespace vasa::test {

/// [s] of a processor that this thread has used: what other programs do does not count.
inline double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace vasa::test
