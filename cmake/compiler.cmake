# Language level, warnings and sanitizers, as one interface target that every other target links.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Sources of one target are compiled eight at a time, which takes half to a quarter of the time: most of what one takes are headers.
# So no two of a target may give a name without a header to different things. Sources that will not be in company say so (vasa_alone).
option(VASA_UNITY "Compile a target's sources eight at a time" ON)
set(CMAKE_UNITY_BUILD ${VASA_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

find_program(VASA_CCACHE ccache)
if(VASA_CCACHE)
  # Told where the tree begins, it finds again what was compiled in another folder.
  set(CMAKE_CXX_COMPILER_LAUNCHER env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${VASA_CCACHE}")
endif()

add_library(vasa_compiler INTERFACE)
# No contraction into fused multiply-adds: the CPU reference and the shaders must round alike,
# and a frame must be the same bits whatever machine compiled it.
target_compile_options(vasa_compiler INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers -ffp-contract=off)
if(VASA_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(vasa_compiler INTERFACE -Wno-subobject-linkage)  # takes a source for a header
endif()
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
