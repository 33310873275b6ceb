# What nearly every source includes, parsed once for the engine's libraries and once for the tests: 1 to 2 s less of the 3 to 9 that one
# takes. A source still includes all that it uses: `./test.sh tidy` looks at engine and apps without this.
set(VASA_PRECOMPILED <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span> <string> <vector>
  <glm/glm.hpp> <glm/gtc/quaternion.hpp>)
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/precompiled.cpp" CONTENT "")

add_library(vasa_precompiled OBJECT EXCLUDE_FROM_ALL "${PROJECT_BINARY_DIR}/precompiled.cpp")
target_link_libraries(vasa_precompiled PRIVATE vasa_compiler)
target_precompile_headers(vasa_precompiled PRIVATE ${VASA_PRECOMPILED})

# Most of a test's time is the engine's, whose libraries are compiled in full; inline functions may be the tests' copies.
add_library(vasa_test_compiler INTERFACE)
target_compile_options(vasa_test_compiler INTERFACE $<$<CONFIG:Release>:-O1>)
add_library(vasa_precompiled_tests OBJECT EXCLUDE_FROM_ALL "${PROJECT_BINARY_DIR}/precompiled.cpp")
set_target_properties(vasa_precompiled_tests PROPERTIES POSITION_INDEPENDENT_CODE OFF)
target_compile_options(vasa_precompiled_tests PRIVATE -fPIE)  # as programs have it, and libraries have not
target_link_libraries(vasa_precompiled_tests PRIVATE vasa_compiler vasa_test_compiler)
target_precompile_headers(vasa_precompiled_tests PRIVATE ${VASA_PRECOMPILED} <doctest/doctest.h>)
