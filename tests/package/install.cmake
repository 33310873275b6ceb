# usage: cmake -DBUILD=<build folder> -DPREFIX=<where to> -P install.cmake: installs anew, leaving nothing of an earlier time.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
# The installed program finds its human beside it and knows nothing of the folder it was built in.
execute_process(COMMAND "${PREFIX}/bin/vasa" info --json OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(JSON vessels GET "${text}" networks 0 vessels)
if(vessels LESS 300)
  message(FATAL_ERROR "the installed program shows a human of ${vessels} vessels")
endif()
file(STRINGS "${PREFIX}/bin/vasa" leaks REGEX "${BUILD}" LIMIT_COUNT 1)
if(leaks)
  message(FATAL_ERROR "the installed program names the build folder: ${leaks}")
endif()
