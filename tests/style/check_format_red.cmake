# Shows that check_format.cmake can fail: a file with one space too many must be refused by name.
#   cmake -DROOT=<repository> -DWORK=<directory to use> -P tests/style/check_format_red.cmake
cmake_minimum_required(VERSION 3.25)
set(check "${ROOT}/tests/style/check_format.cmake")

function(expect text_of_file failing)
  file(REMOVE_RECURSE "${WORK}")
  file(MAKE_DIRECTORY "${WORK}")
  file(COPY "${ROOT}/.clang-format" DESTINATION "${WORK}")
  file(WRITE "${WORK}/sample.cc" "${text_of_file}")
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${WORK}" -P "${check}"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(output MATCHES "Skipped:")
    message(STATUS "${output}")
    return()
  endif()
  if(failing AND (result EQUAL 0 OR NOT output MATCHES "sample[.]cc"))
    message(FATAL_ERROR "A badly formatted file was let through: ${output}")
  elseif(NOT failing AND NOT result EQUAL 0)
    message(FATAL_ERROR "A well formatted file was refused: ${output}")
  endif()
endfunction()

expect("int  one = 1;\n" TRUE)
expect("int one = 1;\n" FALSE)
