# cmake --install: the program, both libraries with their headers, and what find_package(Illumigraph)
# reads. illum_read is an export set of its own: linking it asks for none of the authoring packages.

include(CMakePackageConfigHelpers)
set(ILLUM_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Illumigraph)
set(ILLUM_MODULE_DIR ${CMAKE_INSTALL_LIBDIR}/illumigraph)

# Header-only packages are compiled in: users of the archive have nothing of them to find or link.
function(illum_export_library TARGET SET)
  get_target_property(libraries ${TARGET} INTERFACE_LINK_LIBRARIES)
  list(REMOVE_DUPLICATES libraries)
  list(FILTER libraries EXCLUDE REGEX "Eigen3::|nlohmann_json::|CLI11::")
  set_target_properties(${TARGET} PROPERTIES INTERFACE_LINK_LIBRARIES "${libraries}")
  install(TARGETS ${TARGET} EXPORT ${SET} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT ${SET} NAMESPACE Illumigraph:: DESTINATION ${ILLUM_CONFIG_DIR})
endfunction()

illum_export_library(illum_read IllumigraphReadTargets)
if(ILLUM_AUTHOR)
  illum_export_library(illum_author IllumigraphAuthorTargets)
  # Found from the program, so that both may be moved together; the package's users find it from the
  # package.
  file(RELATIVE_PATH module_from_program ${CMAKE_INSTALL_FULL_BINDIR}
       ${CMAKE_INSTALL_FULL_LIBDIR}/illumigraph)
  set_target_properties(illum PROPERTIES INSTALL_RPATH "$ORIGIN/${module_from_program}")
  install(TARGETS illum RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(TARGETS illum_oiio_module LIBRARY DESTINATION ${ILLUM_MODULE_DIR})
endif()

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/IllumigraphConfig.cmake.in
  ${PROJECT_BINARY_DIR}/IllumigraphConfig.cmake
  INSTALL_DESTINATION ${ILLUM_CONFIG_DIR}
  PATH_VARS ILLUM_MODULE_DIR
  NO_SET_AND_CHECK_MACRO)
# Until 1.0 a minor version may change the interface.
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/IllumigraphConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/IllumigraphConfig.cmake
              ${PROJECT_BINARY_DIR}/IllumigraphConfigVersion.cmake
        DESTINATION ${ILLUM_CONFIG_DIR})

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/illum
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/README.md
              ${PROJECT_SOURCE_DIR}/CHANGELOG.md
              ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
