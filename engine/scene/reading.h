#pragma once
#include <cstddef>
#include <functional>

namespace vasa {

/// Told what a long reading does, and how much of it is done; total 0: nobody knows. From any thread.
using ReadingProgress = std::function<void(const char* what, std::size_t done, std::size_t total)>;

}  // namespace vasa
