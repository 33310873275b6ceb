# vasa_shaders(NAME SHADERS a.comp b.vert ...): compiles GLSL to SPIR-V 1.6, validates it and embeds it.
# Paths count from shaders/ unless they are absolute. Linking vasa_NAME gives, for a.comp,
#   #include "spirv/a_comp.h"        ->  vasa::spirv::a_comp, a constexpr vasa::gpu::ShaderCode
# A shader includes "shared/x.h" and "lib/y.glsl" from shaders/; a changed include rebuilds what uses it.

# Made ready for drivers, which would do the same at each start, slower: calls inlined, variables to values, what is found
# twice found once. No pass that rewrites arithmetic, so that CPU references and pictures hold to the bit.
set(VASA_SPIRV_PASSES
    --merge-return
    --inline-entry-points-exhaustive
    --eliminate-dead-functions
    --private-to-local
    --scalar-replacement=100
    --convert-local-access-chains
    --eliminate-local-single-block
    --eliminate-local-single-store
    --ssa-rewrite
    --eliminate-dead-code-aggressive
    --eliminate-dead-branches
    --merge-blocks
    --redundancy-elimination
    --eliminate-dead-code-aggressive)

find_program(VASA_GLSLANG glslangValidator)
find_program(VASA_SPIRV_VAL spirv-val)
find_program(VASA_SPIRV_OPT spirv-opt)

# A library of shaders, compiled, checked and embedded. SHADERS: files of shaders/.
function(vasa_shaders name)
  cmake_parse_arguments(ARG "" "" "SHADERS" ${ARGN})
  if(NOT VASA_GLSLANG
     OR NOT VASA_SPIRV_OPT
     OR NOT VASA_SPIRV_VAL)
    message(FATAL_ERROR "glslangValidator, spirv-opt or spirv-val is missing; install glslang-tools and spirv-tools")
  endif()
  set(root "${PROJECT_BINARY_DIR}/shaders/${name}")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake")
  set(headers "")
  foreach(shader IN LISTS ARG_SHADERS)
    cmake_path(ABSOLUTE_PATH shader BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/shaders" OUTPUT_VARIABLE source)
    cmake_path(GET source FILENAME file)
    string(MAKE_C_IDENTIFIER "${file}" symbol)
    set(spirv "${root}/${file}.spv")
    set(header "${root}/spirv/${symbol}.h")
    # Compute shaders twice: with words of 64 bits for devices that have them, too (shaders/lib/words.glsl).
    set(codes "${spirv}")
    if(file MATCHES "\\.comp$")
      list(APPEND codes "${spirv}.int64")
    endif()
    set(compile "")
    foreach(code IN LISTS codes)
      list(APPEND compile COMMAND "${VASA_GLSLANG}" --quiet -V --target-env vulkan1.3 $<IF:$<CONFIG:Debug>,-g,-g0>
           "-I${PROJECT_SOURCE_DIR}/shaders" --depfile "${code}.d.in" -o "${code}")
      if(code MATCHES "int64$")
        list(APPEND compile -DVASA_INT64)
      endif()
      list(APPEND compile "${source}")
      list(APPEND compile COMMAND "${VASA_SPIRV_OPT}" --target-env=vulkan1.3 ${VASA_SPIRV_PASSES} "${code}" -o
           "${code}")
      list(APPEND compile COMMAND "${VASA_SPIRV_VAL}" --target-env vulkan1.3 "${code}")
    endforeach()
    add_custom_command(
      OUTPUT "${header}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${root}/spirv"
      ${compile}
      COMMAND "${CMAKE_COMMAND}" "-DSPIRV=${spirv}" "-DHEADER=${header}" "-DSYMBOL=${symbol}" "-DFILE=${file}"
              -P "${script}"
      DEPENDS "${source}" "${script}"
      DEPFILE "${spirv}.d"
      COMMENT "Compiling shader ${file}"
      VERBATIM)
    list(APPEND headers "${header}")
  endforeach()
  add_custom_target(vasa_${name}_spirv DEPENDS ${headers})
  add_library(vasa_${name} INTERFACE)
  add_library(vasa::${name} ALIAS vasa_${name})
  add_dependencies(vasa_${name} vasa_${name}_spirv)
  target_include_directories(vasa_${name} INTERFACE "${root}" "${PROJECT_SOURCE_DIR}/shaders"
                             "${PROJECT_SOURCE_DIR}/engine")
endfunction()
