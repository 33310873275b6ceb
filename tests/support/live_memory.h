#pragma once
#include <cstddef>

// What the program that includes live_memory.cpp has allocated and not yet given back.
namespace vasa::test {

/// Whether it is counted: not under sanitizers, which have an allocator of their own.
bool countsMemory();
/// Forgets the peak so far. @return the bytes that are live
std::size_t restartPeak();
std::size_t peakMemory();
/// How often anything was allocated so far.
std::size_t allocationCount();
/// The same by the program itself, and not by the libraries that it loads (a driver).
std::size_t ownAllocationCount();

}  // namespace vasa::test
