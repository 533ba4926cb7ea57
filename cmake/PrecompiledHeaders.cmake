# ROLLGAIT_PRECOMPILE: whose headers of other projects are parsed once for all targets. ALL is for clang, with which presets compile.
# TESTS is for g++: it takes an eighth off the time of tests, and of libraries and programs a twentieth, which is what their headers cost
# to precompile; and g++ 12 finds more of the faults that are none (GCC bug 105651) where the standard library is precompiled.
# That every file includes what it uses is not the compiler's to see then; tests/style/check_includes.py does.

set(ROLLGAIT_PRECOMPILE "" CACHE STRING
  "Precompile the headers of the standard library, Eigen, gRPC, the messages, CLI11, JSON and GoogleTest: empty, TESTS or ALL")
set_property(CACHE ROLLGAIT_PRECOMPILE PROPERTY STRINGS "" TESTS ALL)

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

  # Lists of one function's arguments: a keyword that comes again goes on.
  set(eigen HEADERS <Eigen/Dense> LIBRARIES Eigen3::Eigen)
  set(messages ${eigen} HEADERS <rollgait/v1/gait_service.pb.h> LIBRARIES rollgait::proto_messages)
  set(wire ${eigen} HEADERS <grpcpp/grpcpp.h> <rollgait/v1/gait_service.grpc.pb.h> <CLI/CLI.hpp> <nlohmann/json.hpp>
    LIBRARIES rollgait::proto)
  if(ROLLGAIT_PRECOMPILE STREQUAL "ALL")
    rollgait_precompiled(core ${eigen} OPTIONS ${ROLLGAIT_COMPUTES})
    rollgait_precompiled(server ${messages})
    rollgait_precompiled(wire ${wire})
  endif()
  if(ROLLGAIT_TESTS)
    set(googletest HEADERS <gmock/gmock.h> <gtest/gtest.h> LIBRARIES GTest::gtest GTest::gmock)
    rollgait_precompiled(numeric_tests ${googletest} ${eigen} OPTIONS ${ROLLGAIT_NUMERIC_TEST_OPTIONS})
    rollgait_precompiled(tests ${googletest} ${eigen} OPTIONS ${ROLLGAIT_TEST_OPTIONS})
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
  elseif(NOT ROLLGAIT_PRECOMPILE STREQUAL "ALL")
    return()
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
