# A second build of the solver for processors with x86-64-v3 (AVX2, FMA): Intel since Haswell (2013), AMD since Excavator (2015).
# Eigen's types are aligned otherwise there, so no library that has them in its headers may be shared between the two builds:
# each gets a twin rollgait_<name>_v3, which only rollgait-solve-v3 asks for.
include(CheckCXXCompilerFlag)
include(CMakeDependentOption)

set(v3_possible OFF)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  check_cxx_compiler_flag(-march=x86-64-v3 ROLLGAIT_COMPILER_HAS_X86_64_V3)
  if(ROLLGAIT_COMPILER_HAS_X86_64_V3 AND CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT ROLLGAIT_SANITIZE)
    set(v3_possible ON)
  endif()
endif()
cmake_dependent_option(ROLLGAIT_X86_64_V3 "Build rollgait-solve for x86-64-v3 too" ON "v3_possible" OFF)

add_library(rollgait_v3_options INTERFACE)
target_compile_options(rollgait_v3_options INTERFACE -march=x86-64-v3)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 to 14 see small Eigen vectors read past their end by vector instructions behind a test of the size.
  target_compile_options(rollgait_v3_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow)
endif()

# rollgait_twins(OUT rollgait::a other ...): the twins of what has one, the rest as it is.
function(rollgait_twins OUT)
  set(twins "")
  foreach(target ${ARGN})
    if(target MATCHES "^rollgait::" AND TARGET ${target}_v3)
      list(APPEND twins ${target}_v3)
    else()
      list(APPEND twins ${target})
    endif()
  endforeach()
  set(${OUT} ${twins} PARENT_SCOPE)
endfunction()

# The twin of a library that rollgait_library has declared.
function(rollgait_library_twin NAME SOURCES DEPS PRIVATE_DEPS)
  rollgait_twins(deps ${DEPS})
  rollgait_twins(private_deps ${PRIVATE_DEPS})
  add_library(rollgait_${NAME}_v3 STATIC EXCLUDE_FROM_ALL ${SOURCES})
  add_library(rollgait::${NAME}_v3 ALIAS rollgait_${NAME}_v3)
  target_link_libraries(rollgait_${NAME}_v3 PUBLIC ${deps} PRIVATE rollgait_options rollgait_v3_options ${private_deps})
  set_target_properties(rollgait_${NAME}_v3 PROPERTIES UNITY_BUILD "${ROLLGAIT_UNITY}")
  target_include_directories(rollgait_${NAME}_v3 PUBLIC "$<TARGET_PROPERTY:rollgait_${NAME},INCLUDE_DIRECTORIES>")
endfunction()
