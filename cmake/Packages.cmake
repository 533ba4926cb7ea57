# Debian packages: scripts/package calls cpack with what this writes. The packages are the install components server, client, python and
# core; the files that are not built by the rest of the project are made by the target package_files. docker/debian holds their sources.
include(GNUInstallDirs)

cmake_host_system_information(RESULT distribution QUERY DISTRIB_ID)
if(NOT distribution STREQUAL "debian")
  return()
endif()
cmake_host_system_information(RESULT debian_version QUERY DISTRIB_VERSION_ID)

set(debian "${PROJECT_SOURCE_DIR}/docker/debian")
set(made "${CMAKE_BINARY_DIR}/package_files")
# Packages of Debian 12 and 13 differ in the libraries that they need.
set(revision "1+deb${debian_version}")
set(server_programs rollgaitd rollgait-agent rollgait-solve rollgait-simulate rollgait-gateway)
if(ROLLGAIT_X86_64_V3)
  list(APPEND server_programs rollgait-solve-v3)
endif()
add_custom_target(package_files
  COMMAND "${debian}/make-files" "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" "${PROJECT_VERSION}" "${revision}" "${made}"
  VERBATIM)
add_dependencies(package_files ${server_programs} rollgait ${targets})

# `cmake --install` without --component leaves out what belongs to Debian alone.
macro(package_install COMPONENT)
  install(${ARGN} COMPONENT ${COMPONENT} EXCLUDE_FROM_ALL)
endmacro()
set(doc "${CMAKE_INSTALL_DATAROOTDIR}/doc")

package_install(server TARGETS ${server_programs} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
package_install(server PROGRAMS "${made}/rollgait-make-certificates" DESTINATION "${CMAKE_INSTALL_SBINDIR}")
package_install(server DIRECTORY "${made}/systemd/" DESTINATION lib/systemd/system)
package_install(server FILES "${debian}/sysusers.conf" DESTINATION lib/sysusers.d RENAME rollgait-server.conf)
package_install(server FILES "${debian}/tmpfiles.conf" DESTINATION lib/tmpfiles.d RENAME rollgait-server.conf)
package_install(server FILES "${made}/door.cfg" "${debian}/door.env" DESTINATION /etc/rollgait)
package_install(server DIRECTORY "${made}/man/server/" DESTINATION "${CMAKE_INSTALL_MANDIR}")
set(pages explanation/door explanation/security explanation/stores how-to/operations how-to/cluster how-to/http how-to/install_on_debian)
list(TRANSFORM pages REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/docs/\\1.md")
package_install(server FILES ${pages} DESTINATION "${doc}/rollgait-server")
package_install(server DIRECTORY docker/observability docker/slurm DESTINATION "${doc}/rollgait-server/examples")

package_install(client TARGETS rollgait RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
package_install(client DIRECTORY "${made}/man/client/" DESTINATION "${CMAKE_INSTALL_MANDIR}")
package_install(client FILES "${made}/completions/rollgait" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
package_install(client FILES "${made}/completions/_rollgait" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
package_install(client FILES "${made}/completions/rollgait.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
package_install(client DIRECTORY scenes DESTINATION "${doc}/rollgait/examples")

package_install(python DIRECTORY "${made}/python/" DESTINATION lib/python3/dist-packages)
package_install(python DIRECTORY client/python/examples DESTINATION "${doc}/python3-rollgait")

# The package of core has what Debian asks for besides; `cmake --install --component core` has not.
package_install(library DIRECTORY examples/library DESTINATION "${doc}/librollgait-dev/examples")

# Names, texts and dependencies; of shared libraries dpkg-shlibdeps knows them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/build/packages")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL server client python core library)
set(CPACK_COMPONENT_CORE_GROUP library)
set(CPACK_COMPONENT_LIBRARY_GROUP library)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/StripPackages.cmake")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "${revision}")
set(CPACK_DEBIAN_PACKAGE_SOURCE rollgait)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_CONTACT "The Rollgait authors <rollgait@localhost>")

# rollgait_package(PART NAME package SECTION science DESCRIPTION "..." [ARCHITECTURE all] [DEPENDS "..."] [RECOMMENDS "..."] [SCRIPTS file...])
macro(rollgait_package PART)
  cmake_parse_arguments(ARG "" "NAME;SECTION;DESCRIPTION;ARCHITECTURE;DEPENDS;RECOMMENDS" "SCRIPTS" ${ARGN})
  string(TOUPPER "${PART}" key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME "${ARG_NAME}")
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION "${ARG_SECTION}")
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${ARG_DESCRIPTION}")
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${ARG_DEPENDS}")
  set(CPACK_DEBIAN_${key}_PACKAGE_RECOMMENDS "${ARG_RECOMMENDS}")
  list(TRANSFORM ARG_SCRIPTS PREPEND "${debian}/${PART}/")
  set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA "${ARG_SCRIPTS}")
  if(ARG_ARCHITECTURE)
    set(CPACK_DEBIAN_${key}_PACKAGE_ARCHITECTURE "${ARG_ARCHITECTURE}")
  else()
    set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON)
  endif()
  package_install(${PART} DIRECTORY "${made}/doc/" DESTINATION "${doc}/${ARG_NAME}")
endmacro()

# Lines of at most 79 characters.
set(about "Rollgait computes optimal walking gaits: a multibody model whose ellipsoidal
feet roll on the ground, an optimal control problem transcribed by
collocation, an interior-point method with exact derivatives, and a verdict of
an independent verifier.\n
")
rollgait_package(server NAME rollgait-server SECTION science
  DESCRIPTION "optimal walking gaits as a gRPC service
${about}This package has the server rollgaitd with its solvers, the agent that solves
on other machines, the HTTP gateway, and systemd units with HAProxy in front."
  DEPENDS "libopenblas0-serial, systemd | systemd-standalone-sysusers, systemd | systemd-standalone-tmpfiles"
  RECOMMENDS "rollgait, haproxy (>= 2.6), openssl"
  SCRIPTS conffiles postinst prerm postrm)
rollgait_package(client NAME rollgait SECTION science
  DESCRIPTION "optimal walking gaits from the command line
${about}This package has the command line client of the service: solves, sweeps,
reports, exports to OpenSim, MuJoCo and others."
  RECOMMENDS "ca-certificates")
rollgait_package(python NAME python3-rollgait SECTION python ARCHITECTURE all
  DESCRIPTION "optimal walking gaits from Python
${about}This package has the Python client of the service, synchronous and asyncio,
with results as numpy arrays."
  DEPENDS "python3 (>= 3.9), python3-grpcio (>= 1.51), python3-numpy (>= 1:1.24), python3-protobuf (>= 3.21)"
  RECOMMENDS "python3-matplotlib (>= 3.6)"
  SCRIPTS postinst prerm)
rollgait_package(library NAME librollgait-dev SECTION libdevel
  DESCRIPTION "optimal walking gaits as a C++ library
${about}This package has the solver as static libraries with headers, for programs
that solve without a server."
  DEPENDS "coinor-libipopt-dev, libeigen3-dev (>= 3.4), libmumps-seq-dev, libopenblas-serial-dev, pkg-config"
  RECOMMENDS "cmake (>= 3.25), g++ (>= 4:12)")

include(CPack)
