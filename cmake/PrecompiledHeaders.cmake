# ROLLGAIT_PRECOMPILE: whose headers of other projects are parsed once for all targets. ALL takes a third of the time off the build with
# sanitizers. TESTS is for Release: libraries and programs stay without, so a missing include still fails there.

set(ROLLGAIT_PRECOMPILE "" CACHE STRING "Precompile the headers of Eigen, GoogleTest and gRPC: empty, TESTS or ALL")
set_property(CACHE ROLLGAIT_PRECOMPILE PROPERTY STRINGS "" TESTS ALL)

if(ROLLGAIT_PRECOMPILE STREQUAL "TESTS" AND NOT ROLLGAIT_TESTS)
  set(ROLLGAIT_PRECOMPILE "")
endif()

if(ROLLGAIT_PRECOMPILE)
  # A precompiled header fits only where its macros and options are the same.
  if(ROLLGAIT_PRECOMPILE STREQUAL "ALL")
    target_compile_definitions(rollgait_options INTERFACE GTEST_HAS_PTHREAD=1)
  endif()
  # Debian 13's tinyxml2 hands on a macro that the C library asks for.
  find_package(tinyxml2 REQUIRED)
  get_target_property(macros tinyxml2::tinyxml2 INTERFACE_COMPILE_DEFINITIONS)
  set(ROLLGAIT_PRECOMPILED_MACROS "")
  if("${macros}" MATCHES "_FILE_OFFSET_BITS=64")
    set(ROLLGAIT_PRECOMPILED_MACROS _FILE_OFFSET_BITS=64)
  endif()
  set(source "${CMAKE_BINARY_DIR}/precompiled.cc")
  file(CONFIGURE OUTPUT "${source}" CONTENT "")
  foreach(part numeric_tests core wire)
    add_library(rollgait_precompiled_${part} OBJECT "${source}")
    target_link_libraries(rollgait_precompiled_${part} PRIVATE rollgait_options Eigen3::Eigen GTest::gtest GTest::gmock)
    target_compile_definitions(rollgait_precompiled_${part} PRIVATE ${ROLLGAIT_PRECOMPILED_MACROS})
    target_precompile_headers(rollgait_precompiled_${part} PRIVATE
      <Eigen/Dense> <functional> <memory> <optional> <random> <string> <variant> <vector> <gmock/gmock.h> <gtest/gtest.h>)
  endforeach()
  target_compile_options(rollgait_precompiled_numeric_tests PRIVATE ${ROLLGAIT_NUMERIC_TEST_OPTIONS})
  if(ROLLGAIT_PRECOMPILE STREQUAL "TESTS")
    target_compile_options(rollgait_precompiled_core PRIVATE ${ROLLGAIT_TEST_OPTIONS})
    target_compile_options(rollgait_precompiled_wire PRIVATE ${ROLLGAIT_TEST_OPTIONS})
  endif()
  target_link_libraries(rollgait_precompiled_wire PRIVATE rollgait::proto)
  target_precompile_headers(rollgait_precompiled_wire PRIVATE
    <grpcpp/grpcpp.h> <rollgait/v1/gait_service.grpc.pb.h>)
endif()

# rollgait_precompile(TARGET): the target uses the precompiled headers of its part of the project.
function(rollgait_precompile TARGET)
  if(NOT ROLLGAIT_PRECOMPILE)
    return()
  endif()
  file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  if(path MATCHES "${ROLLGAIT_NUMERIC_TESTS}")
    set(part numeric_tests)
  elseif(ROLLGAIT_PRECOMPILE STREQUAL "TESTS" AND NOT path MATCHES "^tests/")
    return()
  elseif(path MATCHES "^(tests/)?(server/rpc|client|e2e)")
    set(part wire)
  else()
    set(part core)
  endif()
  target_compile_definitions(${TARGET} PRIVATE ${ROLLGAIT_PRECOMPILED_MACROS})
  target_precompile_headers(${TARGET} REUSE_FROM rollgait_precompiled_${part})
endfunction()
