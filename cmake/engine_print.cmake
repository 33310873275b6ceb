# Writes OUT, a header with a number that tells one engine from another: of all sources of the engine, and of WITH
# (compiler and flags). What one engine keeps (engine/core/kept.h) no other uses.
# usage: cmake -DROOT=<project root> -DWITH=<text> -DOUT=<header> -P engine_print.cmake
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE sources LIST_DIRECTORIES false "${ROOT}/engine/*.cpp" "${ROOT}/engine/*.h" "${ROOT}/shaders/shared/*.h")
list(SORT sources)
set(all "${WITH}")
foreach(source IN LISTS sources)
  file(SHA256 "${source}" hash)
  string(APPEND all "${hash}")
endforeach()
string(SHA256 print "${all}")
string(SUBSTRING "${print}" 0 16 print)
file(WRITE "${OUT}" "#pragma once
#include <cstdint>

namespace vasa {
constexpr std::uint64_t kEnginePrint = 0x${print};
}  // namespace vasa
")
