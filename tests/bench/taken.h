#pragma once
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/result.h"

namespace vasa {

/// What a benchmark cannot go on without; its error ends the program.
template <class T>
T taken(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s\n", result.error().message.c_str());
  std::exit(int(result.error().fault));
}

}  // namespace vasa
