# ROLLGAIT_PRECOMPILE: the headers of other projects are parsed once for all targets. It takes a third of the time off a build from
# nothing. That every file includes what it uses is not the compiler's to see then; tests/style/check_includes.py does.

option(ROLLGAIT_PRECOMPILE "Precompile the headers of the standard library, Eigen, gRPC, the messages and GoogleTest" OFF)

set(ROLLGAIT_PRECOMPILED_STANDARD <functional> <memory> <optional> <random> <string> <variant> <vector>)

# rollgait_precompiled(PART HEADERS header... [LIBRARIES target...] [OPTIONS option...]): the headers that the files of a part share.
function(rollgait_precompiled PART)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  add_library(rollgait_precompiled_${PART} OBJECT "${CMAKE_BINARY_DIR}/precompiled.cc")
  target_link_libraries(rollgait_precompiled_${PART} PRIVATE rollgait_options ${ARG_LIBRARIES})
  target_compile_definitions(rollgait_precompiled_${PART} PRIVATE ${ROLLGAIT_PRECOMPILED_MACROS})
  target_compile_options(rollgait_precompiled_${PART} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(rollgait_precompiled_${PART} PRIVATE ${ROLLGAIT_PRECOMPILED_STANDARD} ${ARG_HEADERS})
endfunction()

if(ROLLGAIT_PRECOMPILE)
  # A precompiled header fits only where its macros and options are the same. Debian 13's tinyxml2 hands on a macro that the C library
  # asks for.
  find_package(tinyxml2 REQUIRED)
  get_target_property(macros tinyxml2::tinyxml2 INTERFACE_COMPILE_DEFINITIONS)
  set(ROLLGAIT_PRECOMPILED_MACROS "")
  if("${macros}" MATCHES "_FILE_OFFSET_BITS=64")
    set(ROLLGAIT_PRECOMPILED_MACROS _FILE_OFFSET_BITS=64)
  endif()
  file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled.cc" CONTENT "")

  set(messages HEADERS <Eigen/Dense> <rollgait/v1/gait_service.pb.h> LIBRARIES Eigen3::Eigen rollgait::proto_messages)
  set(wire HEADERS <Eigen/Dense> <grpcpp/grpcpp.h> <rollgait/v1/gait_service.grpc.pb.h> LIBRARIES Eigen3::Eigen rollgait::proto)
  rollgait_precompiled(core HEADERS <Eigen/Dense> LIBRARIES Eigen3::Eigen OPTIONS ${ROLLGAIT_COMPUTES})
  rollgait_precompiled(server ${messages})
  rollgait_precompiled(wire ${wire})
  if(ROLLGAIT_TESTS)
    # Lists of one function's arguments: a keyword that comes again goes on.
    set(googletest HEADERS <gmock/gmock.h> <gtest/gtest.h> LIBRARIES GTest::gtest GTest::gmock)
    rollgait_precompiled(numeric_tests ${googletest} HEADERS <Eigen/Dense> LIBRARIES Eigen3::Eigen OPTIONS ${ROLLGAIT_NUMERIC_TEST_OPTIONS})
    rollgait_precompiled(tests ${googletest} HEADERS <Eigen/Dense> LIBRARIES Eigen3::Eigen OPTIONS ${ROLLGAIT_TEST_OPTIONS})
    rollgait_precompiled(server_tests ${googletest} ${messages} OPTIONS ${ROLLGAIT_TEST_OPTIONS})
    rollgait_precompiled(wire_tests ${googletest} ${wire} OPTIONS ${ROLLGAIT_TEST_OPTIONS})
  endif()
endif()

# rollgait_precompile(TARGET PATH): the target of the folder PATH uses the precompiled headers of its part of the project.
function(rollgait_precompile TARGET path)
  if(NOT ROLLGAIT_PRECOMPILE)
    return()
  endif()
  if(path MATCHES "${ROLLGAIT_NUMERIC_TESTS}")
    set(part numeric_tests)
  elseif(path MATCHES "^tests/(server/rpc|client|e2e|faults|formats)")
    set(part wire_tests)
  elseif(path MATCHES "^tests/(server|schedules)")
    set(part server_tests)
  elseif(path MATCHES "^tests")
    set(part tests)
  elseif(path MATCHES "^(server/rpc|client)" OR path STREQUAL "server")
    set(part wire)
  elseif(path MATCHES "^(core|bench)")
    set(part core)
  else()
    set(part server)
  endif()
  target_compile_definitions(${TARGET} PRIVATE ${ROLLGAIT_PRECOMPILED_MACROS})
  if(part MATCHES "tests$")
    # GoogleTest's macro, for what helps tests and has none of its own.
    target_compile_definitions(${TARGET} PRIVATE GTEST_HAS_PTHREAD=1)
  endif()
  if(part MATCHES "^wire")
    # gRPC's macros, for what speaks no gRPC itself.
    target_compile_options(${TARGET} PRIVATE "$<TARGET_PROPERTY:PkgConfig::GRPCPP,INTERFACE_COMPILE_OPTIONS>")
  endif()
  target_precompile_headers(${TARGET} REUSE_FROM rollgait_precompiled_${part})
endfunction()
