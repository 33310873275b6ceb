#pragma once
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace vasa {

/// Memory that is read all over the place every frame: from 4 MiB on it asks the system for large pages, so
/// that most reads find their page's address in the processor. Only speed depends on whether the system gives
/// them.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t count) {
    if (count > (kMost - kPage) / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t alignment = isLarge(count) ? kPage : kLeastAlignment;
    const std::size_t bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
    void* const memory = std::aligned_alloc(alignment, bytes);
    if (!memory) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    if (isLarge(count)) madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }

 private:
  static constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max();
  static constexpr std::size_t kPage = std::size_t(2) << 20;
  static constexpr std::size_t kLeastAlignment = alignof(T) > 64 ? alignof(T) : 64;
  static bool isLarge(std::size_t count) { return count >= 2 * kPage / sizeof(T); }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace vasa
