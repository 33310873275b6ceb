#include "support/live_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
#define VASA_OWN_ALLOCATOR 0
#else
#define VASA_OWN_ALLOCATOR 1
#endif

// The program's code, without the libraries that it loads.
extern "C" const char __executable_start, etext;

namespace {

std::atomic<std::size_t> live{0}, peak{0}, allocations{0}, ownAllocations{0};

}  // namespace

namespace vasa::test {

bool countsMemory() { return VASA_OWN_ALLOCATOR; }

std::size_t restartPeak() {
  peak = live.load();
  return live;
}

std::size_t peakMemory() { return peak; }

std::size_t allocationCount() { return allocations; }
std::size_t ownAllocationCount() { return ownAllocations; }

}  // namespace vasa::test

#if VASA_OWN_ALLOCATOR
void* operator new(std::size_t size) {
  void* const memory = std::malloc(size ? size : 1);
  if (!memory) throw std::bad_alloc();
  ++allocations;
  const auto from = reinterpret_cast<const char*>(__builtin_return_address(0));
  if (from >= &__executable_start && from < &etext) ++ownAllocations;
  const std::size_t now = live += malloc_usable_size(memory);
  std::size_t most = peak;
  while (now > most && !peak.compare_exchange_weak(most, now)) {
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  if (memory) live -= malloc_usable_size(memory);
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
#endif
