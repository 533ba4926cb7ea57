# Checks that every C++ file is as .clang-format says.
#   cmake -DROOT=<repository> -P tests/style/check_format.cmake
# Versions of clang-format differ in what they make of the same style, so only one is asked: that of Debian 12. Where it
# is absent, the check says so and passes.
cmake_minimum_required(VERSION 3.25)
if(NOT IS_DIRECTORY "${ROOT}")
  message(FATAL_ERROR "Say where the repository is: cmake -DROOT=<repository> -P ${CMAKE_CURRENT_LIST_FILE}")
endif()

set(VERSION_ASKED 14)
find_program(CLANG_FORMAT NAMES clang-format-${VERSION_ASKED} clang-format)
set(version "none")
if(CLANG_FORMAT)
  execute_process(COMMAND "${CLANG_FORMAT}" --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(NOT version MATCHES "version ${VERSION_ASKED}[.]")
  message(STATUS "Skipped: clang-format ${VERSION_ASKED} is not installed (found: ${version}).")
  return()
endif()

file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/*.cc" "${ROOT}/*.h")
list(FILTER files EXCLUDE REGEX "^build/|^[.]git(/|$)")
execute_process(COMMAND "${CLANG_FORMAT}" --dry-run -Werror ${files} WORKING_DIRECTORY "${ROOT}"
  RESULT_VARIABLE failed ERROR_VARIABLE complaints)
if(failed)
  string(REGEX MATCHALL "[^\n]*error:[^\n]*" places "${complaints}")
  list(SUBLIST places 0 20 places)
  list(JOIN places "\n  " text)
  message(FATAL_ERROR "Not formatted; run clang-format -i on these files:\n  ${text}")
endif()
list(LENGTH files count)
message(STATUS "${count} files are formatted.")
