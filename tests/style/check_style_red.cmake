# Shows that check_style.cmake can fail: writes one bad file at a time and expects a refusal that names it.
#   cmake -DROOT=<repository> -DWORK=<directory to use> -P tests/style/check_style_red.cmake
cmake_minimum_required(VERSION 3.25)

function(expect_refused file content what)
  file(REMOVE_RECURSE "${WORK}")
  file(WRITE "${WORK}/core/base/good.h" "#pragma once\n")
  file(WRITE "${WORK}/${file}" "${content}")
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${WORK}" -P "${ROOT}/tests/style/check_style.cmake"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake wraps long lines
  string(FIND "${output}" "${file}: ${what}" named)
  if(result EQUAL 0 OR named EQUAL -1)
    message(FATAL_ERROR "${file} was not refused with '${what}':\n${output}")
  endif()
endfunction()

string(REPEAT "int x;\n" 151 long_header)
string(REPEAT "int x;\n" 351 long_source)
expect_refused(core/base/long.h "${long_header}" "151 lines")
expect_refused(core/base/long.cc "${long_source}" "351 lines")
expect_refused(tests/core/empty_test.cc "#include <a>\n" "holds no test case")
expect_refused(tests/core/idle_test.cc "\nTEST(A, Good) {\n  EXPECT_EQ(1, 1);\n}\n\nTEST(A, Idle) {\n  f();\n}\n"
  "TEST(A, Idle) asserts nothing")
string(CONCAT unfinished "// TO" "DO: later\n")
expect_refused(core/base/late.cc "${unfinished}" "unfinished work")
string(CONCAT machine "see /ho" "me/someone/x\n")
expect_refused(docs/where.md "${machine}" "a directory of one machine")
string(CONCAT host "from deb.deb" "ian.org\n")
expect_refused(scripts/fetch "${host}" "a host of a package registry")
file(REMOVE_RECURSE "${WORK}")
message(STATUS "7 planted faults were refused.")
