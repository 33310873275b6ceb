# vasa_library(NAME SOURCES ... [HEADERS ...] [LINK ...] [PRIVATE_LINK ...] [BUILD_LINK ...]): the static library of
# engine/NAME. What it may see of the other engine folders comes from the layer table. LINK, PRIVATE_LINK and
# BUILD_LINK name third-party targets: those its headers include, those it only links, and those that leave no trace
# outside the build (headers of its own sources). HEADERS are what other programs may include (cmake/install.cmake).
function(vasa_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;LINK;PRIVATE_LINK;BUILD_LINK" ${ARGN})
  add_library(vasa_${name} STATIC ${ARG_SOURCES})
  add_library(vasa::${name} ALIAS vasa_${name})
  target_include_directories(vasa_${name} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine>" "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders>")
  target_link_libraries(vasa_${name} PUBLIC $<BUILD_INTERFACE:vasa_compiler> ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  foreach(target IN LISTS ARG_BUILD_LINK)
    target_link_libraries(vasa_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
  endforeach()
  foreach(layer IN LISTS VASA_MAY_INCLUDE_${name})
    if(EXISTS "${PROJECT_SOURCE_DIR}/engine/${layer}/CMakeLists.txt")
      target_link_libraries(vasa_${name} PUBLIC vasa_${layer})
    endif()
  endforeach()
  vasa_install_library(${name} ${ARG_HEADERS})
endfunction()

# vasa_alone(SOURCES ...): not compiled in one with others, as macros would act on both, or as they are compiled anew oftener.
function(vasa_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Most of a test's time is the engine's, whose libraries are compiled in full; inline functions may be the tests' copies.
add_library(vasa_test_compiler INTERFACE)
target_compile_options(vasa_test_compiler INTERFACE $<$<CONFIG:Release>:-O1>)

# vasa_test(NAME SOURCES ... LINK ...): one doctest program, one ctest entry. SECONDS: of one that takes long, so that it begins first
# where several run at a time.
function(vasa_test name)
  cmake_parse_arguments(ARG "" "SECONDS" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE vasa_test_compiler vasa_test_support ${ARG_LINK})
  add_test(NAME ${name} COMMAND test_${name} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
  if(ARG_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}")
  endif()
  if(ARG_SECONDS)
    set_tests_properties(${name} PROPERTIES COST ${ARG_SECONDS})
  endif()
endfunction()
