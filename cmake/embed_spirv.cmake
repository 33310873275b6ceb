# Run at build time: writes a SPIR-V file (and x.comp.spv.int64, if it is there) as a C++ header, and the compiler's
# list of includes as a depfile of
# that header (glslangValidator names the SPIR-V file in it, the build waits for the header).
# usage: cmake -DSPIRV=x.comp.spv -DHEADER=x_comp.h -DSYMBOL=x_comp -DFILE=x.comp -P embed_spirv.cmake
cmake_minimum_required(VERSION 3.25)

# inline constexpr std::uint32_t NAME[], four little-endian bytes a word, ten words a line.
function(array_of file name)
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
  set(ten "...........")
  string(REPEAT "${ten}" 10 line)
  string(REGEX REPLACE "(${line})" "\\1\n  " words "${words}")
  string(APPEND arrays "inline constexpr std::uint32_t ${name}[] = {\n  ${words}\n};\n")
  set(arrays "${arrays}" PARENT_SCOPE)
endfunction()

array_of("${SPIRV}" ${SYMBOL}_words)
set(names "${SYMBOL}_words")
if(EXISTS "${SPIRV}.int64")
  array_of("${SPIRV}.int64" ${SYMBOL}_int64)
  string(APPEND names ", ${SYMBOL}_int64")
endif()
file(WRITE "${HEADER}" "// Generated from ${FILE}.
#pragma once
#include <cstdint>

#include \"gpu/shader.h\"

namespace vasa::spirv {
${arrays}inline constexpr gpu::ShaderCode ${SYMBOL}{\"${FILE}\", ${names}};
}  // namespace vasa::spirv
")
file(READ "${SPIRV}.d.in" dependencies)
string(REPLACE "${SPIRV}:" "${HEADER}:" dependencies "${dependencies}")
file(WRITE "${SPIRV}.d" "${dependencies}")
