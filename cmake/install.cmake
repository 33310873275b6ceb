# What `cmake --install` puts where. Component `program`: the command line, its data, manuals. Component `library`:
#   include/vasa/FOLDER/X.h   lib/libvasa_FOLDER.a   lib/cmake/vasa/  (find_package(vasa), targets vasa::FOLDER)
# Folders from gpu on need Vulkan and make a package component of their own, `render`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(VASA_RENDER_LAYERS gpu render)

# Installs a folder's library and notes the headers that other programs may include; what those include is installed too.
function(vasa_install_library name)
  set(export vasaTargets)
  if(name IN_LIST VASA_RENDER_LAYERS)
    set(export vasaRenderTargets)
  endif()
  set_target_properties(vasa_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(vasa_${name} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  # What its headers mean must not depend on who compiles them.
  target_compile_features(vasa_${name} INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
  target_compile_definitions(vasa_${name} INTERFACE $<INSTALL_INTERFACE:GLM_FORCE_DEPTH_ZERO_TO_ONE>
                             $<INSTALL_INTERFACE:GLM_ENABLE_EXPERIMENTAL>)
  install(TARGETS vasa_${name} EXPORT ${export} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
  list(TRANSFORM ARGN PREPEND "${name}/")
  set_property(GLOBAL APPEND PROPERTY VASA_PUBLIC_HEADERS ${ARGN})
endfunction()

# After all folders: headers, exported targets, and the files that find_package reads.
function(vasa_install_package)
  set(package "${CMAKE_INSTALL_LIBDIR}/cmake/vasa")
  get_property(headers GLOBAL PROPERTY VASA_PUBLIC_HEADERS)
  set(gathered "${PROJECT_BINARY_DIR}/public_headers")
  install(CODE "execute_process(
    COMMAND \"${CMAKE_COMMAND}\" \"-DROOT=${PROJECT_SOURCE_DIR}\" \"-DHEADERS=${headers}\" \"-DOUT=${gathered}\"
            -P \"${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT library)
  install(DIRECTORY "${gathered}/vasa" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)

  foreach(set vasaTargets vasaRenderTargets)
    install(EXPORT ${set} NAMESPACE vasa:: DESTINATION "${package}" COMPONENT library)
  endforeach()
  set(VASA_DATA_FOLDER "${CMAKE_INSTALL_DATADIR}/vasa")
  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/vasaConfig.cmake.in" "${PROJECT_BINARY_DIR}/vasaConfig.cmake"
                                INSTALL_DESTINATION "${package}" PATH_VARS VASA_DATA_FOLDER)
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/vasaConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/vasaConfig.cmake" "${PROJECT_BINARY_DIR}/vasaConfigVersion.cmake"
          DESTINATION "${package}" COMPONENT library)
endfunction()
