# With ROLLGAIT_PRECOMPILE the headers of other projects are parsed once for all targets, which takes a third of the time
# off the build with sanitizers. The Release build does without, so a missing include still fails there.

option(ROLLGAIT_PRECOMPILE "Precompile the headers of Eigen, GoogleTest and gRPC" OFF)

if(ROLLGAIT_PRECOMPILE)
  # A precompiled header fits only where its macros are the same.
  target_compile_definitions(rollgait_options INTERFACE GTEST_HAS_PTHREAD=1)
  set(source "${CMAKE_BINARY_DIR}/precompiled.cc")
  file(CONFIGURE OUTPUT "${source}" CONTENT "")
  foreach(part core wire)
    add_library(rollgait_precompiled_${part} OBJECT "${source}")
    target_link_libraries(rollgait_precompiled_${part} PRIVATE rollgait_options Eigen3::Eigen GTest::gtest GTest::gmock)
    target_precompile_headers(rollgait_precompiled_${part} PRIVATE
      <Eigen/Dense> <functional> <memory> <optional> <random> <string> <variant> <vector> <gmock/gmock.h> <gtest/gtest.h>)
  endforeach()
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
  set(part core)
  if(path MATCHES "^(tests/)?(server/rpc|client|e2e)")
    set(part wire)
  endif()
  target_precompile_headers(${TARGET} REUSE_FROM rollgait_precompiled_${part})
endfunction()
