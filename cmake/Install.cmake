# What `cmake --install TREE --component core` puts below its prefix: the layers of core/ as static libraries, their headers, and what
# find_package(rollgait) reads. examples/library uses it, tests/install builds that. The build for x86-64-v3 is not installed.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(parts base math geometry multibody nlp contact simulation models ocp trajectory transcription validation gait_request gait core)
set(targets "")
foreach(part ${parts})
  set_target_properties(rollgait_${part} PROPERTIES EXPORT_NAME ${part})
  list(APPEND targets rollgait_${part})
endforeach()

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/rollgait")
install(TARGETS ${targets} EXPORT rollgait ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT core)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/core" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/rollgait" COMPONENT core
  FILES_MATCHING PATTERN "*.h")
install(EXPORT rollgait NAMESPACE rollgait:: FILE rollgaitTargets.cmake DESTINATION "${package}" COMPONENT core)
configure_package_config_file(cmake/rollgaitConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/rollgaitConfig.cmake"
  INSTALL_DESTINATION "${package}")
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/rollgaitConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/rollgaitConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/rollgaitConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindIpopt.cmake" DESTINATION "${package}" COMPONENT core)
