# Ipopt through its pkg-config file, whose flags matter (coin/ or coin-or/, -DHAVE_CSTDDEF). Defines Ipopt::Ipopt.
find_package(PkgConfig REQUIRED)
pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET GLOBAL ipopt)
if(NOT TARGET Ipopt::Ipopt)
  add_library(Ipopt::Ipopt INTERFACE IMPORTED GLOBAL)
  target_link_libraries(Ipopt::Ipopt INTERFACE PkgConfig::IPOPT)
endif()
set(Ipopt_FOUND TRUE)
