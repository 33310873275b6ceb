# Language level, warnings and sanitizers, as one interface target that every other target links.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(VASA_CCACHE ccache)
if(VASA_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${VASA_CCACHE}")
  # Of what was compiled with parsed headers (cmake/precompiled.cmake) a cache finds nothing again in another folder.
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON CACHE BOOL "")
endif()

add_library(vasa_compiler INTERFACE)
# No contraction into fused multiply-adds: the CPU reference and the shaders must round alike,
# and a frame must be the same bits whatever machine compiled it.
target_compile_options(vasa_compiler INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers -ffp-contract=off)
if(VASA_WERROR)
  target_compile_options(vasa_compiler INTERFACE -Werror)
endif()
# Files come from anywhere: what a missed check would overwrite is guarded. Tables of functions are read-only once loaded.
target_link_options(vasa_compiler INTERFACE -Wl,-z,relro -Wl,-z,now)
# So are return addresses, and copies whose room the compiler knows; it knows rooms with optimisation alone. Sanitizers watch more.
target_compile_options(vasa_compiler INTERFACE -fstack-protector-strong)
if(NOT VASA_SANITIZE)
  target_compile_options(vasa_compiler INTERFACE $<$<CONFIG:Release,RelWithDebInfo>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2>)
endif()
if(VASA_SANITIZE)
  target_compile_options(vasa_compiler INTERFACE -fsanitize=${VASA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(vasa_compiler INTERFACE -fsanitize=${VASA_SANITIZE})
  if(VASA_SANITIZE MATCHES "undefined")
    target_compile_options(vasa_compiler INTERFACE -fno-sanitize-recover=undefined)
  endif()
endif()
target_compile_definitions(vasa_compiler INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
