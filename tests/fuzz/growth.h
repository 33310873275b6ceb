#pragma once
#include <doctest/doctest.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

// Shapes of files that once took time or memory in the square of a file's size, or a thousand times its size:
// each is made n, 2n and 4n large, and read or refused within the limits of io/read_limits.h.
namespace vasa::test {

struct Shape {
  const char* name;
  std::size_t n;  ///< the smallest
  std::function<std::string(std::size_t)> make;
};

std::string times(std::size_t n, const std::function<std::string(std::size_t)>& part);
std::string times(std::size_t n, const std::string& part);
inline std::string of(std::size_t i) { return std::to_string(i); }
/// @param items  each with a comma behind it
inline std::string list(const std::string& items) { return "[" + items.substr(0, items.size() - 1) + "]"; }
inline std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

/// What a reader refuses is bad input. @return its message; empty where it was read
template <class T>
std::string messageOf(const Result<T>& result) {
  if (result) return {};
  CHECK(result.error().fault == Fault::badInput);
  return result.error().message;
}

/// @param read  gives the message of a refusal
void checkGrowth(const std::vector<Shape>& shapes,
                 const std::function<std::string(const std::string&)>& read);

}  // namespace vasa::test
