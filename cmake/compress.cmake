# Run at build time: manual pages as Debian installs them, packed and in folders by section.
# usage: cmake -DFOLDER=<folder> -DGZIP=<gzip> -P compress.cmake
foreach(section 1 7)
  file(GLOB pages "${FOLDER}/*.${section}")
  file(COPY ${pages} DESTINATION "${FOLDER}/man${section}")
  file(REMOVE ${pages})
  file(GLOB pages "${FOLDER}/man${section}/*.${section}")
  execute_process(COMMAND "${GZIP}" -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
