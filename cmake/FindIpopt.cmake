# Ipopt through its pkg-config file, whose flags matter (coin/ or coin-or/, -DHAVE_CSTDDEF). Defines Ipopt::Ipopt.
find_package(PkgConfig REQUIRED)
pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET GLOBAL ipopt)

# The Ipopt of Debian 13 takes MUMPS for MPI and starts MPI when it is loaded: a thread, a segment of shared memory that stays behind,
# a quarter of a second. Linked before it, sequential MUMPS and its MPI of one process take the place of both.
find_library(DMUMPS_SEQ NAMES dmumps_seq REQUIRED)
find_library(MPISEQ NAMES mpiseq_seq REQUIRED)
if(NOT TARGET Ipopt::Ipopt)
  add_library(Ipopt::Ipopt INTERFACE IMPORTED GLOBAL)
  target_link_libraries(Ipopt::Ipopt INTERFACE
    -Wl,--push-state,--no-as-needed "${DMUMPS_SEQ}" "${MPISEQ}" -Wl,--pop-state PkgConfig::IPOPT)
endif()
set(Ipopt_FOUND TRUE)
