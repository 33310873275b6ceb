# Run by ctest: no two headers define a type or an inline function of the same name and arguments in the same namespace. A linker
# takes either of two such, without a word: what reads with the one and writes with the other works as long as both are inlined.
# Definitions are known by standing at a line's beginning, as the format has it.
# usage: cmake -DROOT=<project root> -P check_names.cmake
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE headers RELATIVE "${ROOT}" "${ROOT}/engine/*.h" "${ROOT}/apps/*.h")
list(SORT headers)
set(faults "")
set(count 0)
foreach(header IN LISTS headers)
  file(READ "${ROOT}/${header}" text)
  # Semicolons and brackets would divide the list of matches, or keep it together.
  string(REGEX REPLACE "[][]" "|" text "${text}")
  string(REPLACE ";" "|" text "${text}")
  string(REGEX MATCHALL "\n(namespace [a-z:]+|(class|struct|union|enum class) [A-Za-z0-9]+[^|{}()]*|inline [^|{}()=]+\\([^|{}]*\\)[^|{}()=]*) ?{"
               definitions "${text}")
  set(space "")
  foreach(definition IN LISTS definitions)
    string(REGEX REPLACE "[ \n]+" " " definition "${definition}")
    if(definition MATCHES "^ namespace ([a-z:]+)")
      set(space "${CMAKE_MATCH_1}")
      continue()
    elseif(definition MATCHES "^ inline .*[ &*]([A-Za-z0-9_]+)\\((.*)\\)")
      set(name "${CMAKE_MATCH_1}(${CMAKE_MATCH_2})")
      # Types of arguments, without their names and values.
      string(REGEX REPLACE "( [A-Za-z0-9_]+)?( = [^,]*)?(,|\\))" "\\3" name "${name}")
    elseif(definition MATCHES "^ (class|struct|union|enum class) ([A-Za-z0-9]+)")
      set(name "${CMAKE_MATCH_2}")
    else()
      continue()
    endif()
    math(EXPR count "${count} + 1")
    string(MAKE_C_IDENTIFIER "${space}::${name}" key)
    if(DEFINED "in_${key}" AND NOT "${in_${key}}" STREQUAL header)
      string(APPEND faults "  ${space}::${name} in ${in_${key}} and ${header}\n")
    endif()
    set("in_${key}" "${header}")
  endforeach()
endforeach()
if(faults)
  message(FATAL_ERROR "two things of one name, of which a linker takes either:\n${faults}")
endif()
message(STATUS "${count} names mean one thing each")
