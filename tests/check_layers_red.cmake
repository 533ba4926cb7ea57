# Shows that check_layers.cmake can fail: copies the sources, plants bad includes and expects a refusal that names the
# file and the header of each.
#   cmake -DROOT=<repository> -DWORK=<directory to use> -P tests/check_layers_red.cmake
cmake_minimum_required(VERSION 3.25)

set(PLANTS
  "core/nlp/planted.cc"          "core/multibody/model.h"            # nlp knows no physics
  "core/geometry/planted.cc"     "core/multibody/model.h"            # sideways
  "core/base/planted.h"          "core/math/planted.h"               # upward
  "core/validation/planted.cc"   "core/transcription/planted.h"      # the judge and the judged
  "core/ocp/planted.cc"          "grpcpp/grpcpp.h"
  "core/contact/planted.cc"      "rollgait/v1/solve.pb.h"
  "core/gait/planted.cc"         "spdlog/spdlog.h"
  "core/gait/planted.cc"         "coin/IpTNLP.hpp"
  "core/gait/planted.cc"         "IpIpoptApplication.hpp"
  "core/gait/planted.cc"         "tests/support/planted.h"
  "core/attic/planted.cc"        "core/base/types.h"                 # a layer nobody declared
  "core/math/planted.cc"         "planted.h"                         # not from the root
  "server/store/planted.cc"      "server/service/planted.h"
  "server/service/planted.cc"    "grpcpp/grpcpp.h"
  "server/rpc/planted.cc"        "core/gait/optimizing_gait_solver.h"
  "server/agent/planted.cc"      "core/gait/optimizing_gait_solver.h"
  "server/store/planted.cc"      "core/models/scene.h"
  "server/rpc/planted.cc"        "client/text.h"
  "client/planted.cc"            "core/base/types.h"
  "client/planted.cc"            "server/base/planted.h")

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
file(COPY "${ROOT}/core" "${ROOT}/server" "${ROOT}/client" DESTINATION "${WORK}")

function(run_check)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${WORK}" -P "${ROOT}/tests/check_layers.cmake"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result "${result}" PARENT_SCOPE)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake wraps long lines
  set(output "${output}" PARENT_SCOPE)
endfunction()

run_check()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "The unchanged copy is refused:\n${output}")
endif()
# All at once: every one is to be named.
set(count 0)
set(planted ${PLANTS})
while(planted)
  list(POP_FRONT planted file header)
  file(APPEND "${WORK}/${file}" "#include \"${header}\"\n")
endwhile()
run_check()
while(PLANTS)
  list(POP_FRONT PLANTS file header)
  string(FIND "${output}" "${file}: ${header}:" named)
  if(result EQUAL 0 OR named EQUAL -1)
    message(FATAL_ERROR "${file} including ${header} was not refused by name:\n${output}")
  endif()
  math(EXPR count "${count} + 1")
endwhile()
file(REMOVE_RECURSE "${WORK}")
message(STATUS "${count} planted includes were refused.")
