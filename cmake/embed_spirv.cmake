# Run at build time: writes a SPIR-V file as a C++ header, and the compiler's list of includes as a depfile of
# that header (glslangValidator names the SPIR-V file in it, the build waits for the header).
# usage: cmake -DSPIRV=x.comp.spv -DHEADER=x_comp.h -DSYMBOL=x_comp -DFILE=x.comp -P embed_spirv.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${SPIRV}" hex HEX)
# Four little-endian bytes a word, ten words a line.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
set(ten "...........")
string(REPEAT "${ten}" 10 line)
string(REGEX REPLACE "(${line})" "\\1\n  " words "${words}")
file(WRITE "${HEADER}" "// Generated from ${FILE}.
#pragma once
#include <cstdint>

#include \"gpu/shader.h\"

namespace vasa::spirv {
inline constexpr std::uint32_t ${SYMBOL}_words[] = {
  ${words}
};
inline constexpr gpu::ShaderCode ${SYMBOL}{\"${FILE}\", ${SYMBOL}_words};
}  // namespace vasa::spirv
")
file(READ "${SPIRV}.d.in" dependencies)
string(REPLACE "${SPIRV}:" "${HEADER}:" dependencies "${dependencies}")
file(WRITE "${SPIRV}.d" "${dependencies}")
