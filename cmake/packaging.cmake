# `cpack --config build/release/CPackConfig.cmake -B out`: two Debian packages, vasa (program, human, manuals, completions,
# desktop entry) and libvasa-dev (headers, static libraries, find_package). The manuals and completions come out of the
# program itself, so they are as new as it is.
find_program(VASA_GZIP gzip)

# Manual pages and completions, written by the program.
function(vasa_install_manuals)
  if(NOT VASA_GZIP OR CMAKE_CROSSCOMPILING)
    return()
  endif()
  set(out "${PROJECT_BINARY_DIR}/manuals")
  add_custom_command(
    OUTPUT "${out}/done"
    COMMAND ${CMAKE_COMMAND} -E rm -rf "${out}"
    COMMAND vasa help --write "${out}"
    COMMAND ${CMAKE_COMMAND} "-DFOLDER=${out}" "-DGZIP=${VASA_GZIP}" -P "${PROJECT_SOURCE_DIR}/cmake/compress.cmake"
    COMMAND ${CMAKE_COMMAND} -E touch "${out}/done"
    DEPENDS vasa "${PROJECT_SOURCE_DIR}/cmake/compress.cmake" VERBATIM COMMENT "Writing manual pages and completions")
  add_custom_target(manuals ALL DEPENDS "${out}/done")
  add_dependencies(manuals human)  # whose clips are completed
  install(DIRECTORY "${out}/man1" "${out}/man7" DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  set(data ${CMAKE_INSTALL_DATADIR})
  install(FILES "${out}/vasa.bash" DESTINATION ${data}/bash-completion/completions RENAME vasa COMPONENT program)
  install(FILES "${out}/_vasa" DESTINATION ${data}/zsh/vendor-completions COMPONENT program)
  install(FILES "${out}/vasa.fish" DESTINATION ${data}/fish/vendor_completions.d COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/data/desktop/vasa.desktop" DESTINATION ${data}/applications COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/data/desktop/vasa.svg" DESTINATION ${data}/icons/hicolor/scalable/apps COMPONENT program)
endfunction()

# Debian wants licence and list of changes in a folder of each package's name.
function(vasa_install_debian_papers package component)
  set(folder "${CMAKE_INSTALL_DATADIR}/doc/${package}")
  install(FILES "${PROJECT_BINARY_DIR}/debian/copyright" DESTINATION "${folder}" COMPONENT ${component})
  install(FILES "${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz" DESTINATION "${folder}" COMPONENT ${component})
endfunction()

# Writes both: of the licence and of this version.
function(vasa_write_debian_papers)
  file(READ "${PROJECT_SOURCE_DIR}/LICENSE" licence)
  string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)" line "${licence}")
  set(holder "${CMAKE_MATCH_1}")
  string(REGEX REPLACE "^.*\nPermission is" "Permission is" text "${licence}")
  string(STRIP "${text}" text)
  string(REGEX REPLACE "\n\n" "\n.\n" text "${text}")
  string(REPLACE "\n" "\n " text "${text}")
  file(WRITE "${PROJECT_BINARY_DIR}/debian/copyright"
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: vasa

Files: *
Copyright: ${holder}
License: MIT
 ${text}
")
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE "${PROJECT_BINARY_DIR}/debian/changelog.Debian"
"vasa (${PROJECT_VERSION}-1) bookworm; urgency=medium

  * Version ${PROJECT_VERSION}.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  if(VASA_GZIP)
    execute_process(COMMAND "${VASA_GZIP}" -9nf "${PROJECT_BINARY_DIR}/debian/changelog.Debian" COMMAND_ERROR_IS_FATAL ANY)
    vasa_install_debian_papers(vasa program)
    vasa_install_debian_papers(libvasa-dev library)
  endif()
endfunction()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vasa)
set(CPACK_PACKAGE_CONTACT "The vasa authors <authors@vasa.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "blood vessels that move with their body")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vasa)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, ffmpeg")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Takes polygonal blood vessels and a rigged body, turns the vessels into one
network of smooth tubes, binds it to the skeleton and draws it through Vulkan:
no vessel runs through another, each keeps its volume, branches join smoothly.
.
Comes with a human of its own. Works with or without a graphics card.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libvasa-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libdraco-dev, libfmt-dev, libglm-dev, libhwy-dev, libmeshoptimizer-dev, libpng-dev, \
libstdc++-12-dev, libtbb-dev, libtinyxml2-dev, zlib1g-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libvulkan-dev, vasa (= ${PROJECT_VERSION}-1)")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"C++20 headers, static libraries and CMake files of vasa, which moves blood
vessels with a body: posing and interference need no Vulkan, drawing can use
the Vulkan device of another program.")

vasa_install_manuals()
vasa_write_debian_papers()
include(CPack)
