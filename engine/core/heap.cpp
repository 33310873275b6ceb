#include "core/heap.h"

#include <cstdlib>  // says which C library this is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace vasa {

#ifdef __GLIBC__
void keepHeapSmall() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
}

void returnFreedMemory() { malloc_trim(0); }
#else
void keepHeapSmall() {}
void returnFreedMemory() {}
#endif

}  // namespace vasa
