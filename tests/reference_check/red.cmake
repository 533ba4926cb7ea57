# Shows that reference_check, which accepts the file as it is (the test reference_check.<family>), can fail: on the file
# with one digit altered (status 1), on one with an unknown field, on one of no family and on one that is not JSON
# (status 2).
#   cmake -DPROGRAM=reference_check -DFILE=file.json -DFIELD=cases,0,expect,r,0 -DWORK=folder -P red.cmake

cmake_minimum_required(VERSION 3.25)

function(expect_status status text what)
  file(WRITE "${WORK}/case.json" "${text}")
  execute_process(COMMAND "${PROGRAM}" "${WORK}/case.json" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(NOT result STREQUAL status)
    message(FATAL_ERROR "${what}: reference_check ended with ${result}, not ${status}")
  endif()
endfunction()

# Trajectories have tables beside their file.
get_filename_component(directory "${FILE}" DIRECTORY)
file(GLOB tables "${directory}/*.csv")
file(COPY ${tables} DESTINATION "${WORK}")
file(READ "${FILE}" text)

# The tenth digit behind the point of one expected value.
string(REPLACE "," ";" path "${FIELD}")
string(JSON number GET "${text}" ${path})
if(NOT number MATCHES "^(-?[0-9][.][0-9][0-9][0-9][0-9][0-9][0-9][0-9][0-9][0-9])([0-9])(.*)$")
  message(FATAL_ERROR "${FIELD} is '${number}', which has no ten digits behind the point")
endif()
set(head "${CMAKE_MATCH_1}")
set(tail "${CMAKE_MATCH_3}")
math(EXPR digit "(${CMAKE_MATCH_2} + 5) % 10")
string(JSON altered SET "${text}" ${path} "\"${head}${digit}${tail}\"")
expect_status(1 "${altered}" "${FIELD} changed from ${number} to ${head}${digit}${tail}")

string(REGEX REPLACE "\"(expect|parameters)\": {" "\"\\1\": {\"unheard_of\": 1, " unknown "${text}")
string(REGEX REPLACE "\"kappa\":" "\"unheard_of\": 1, \"kappa\":" unknown "${unknown}")
expect_status(2 "${unknown}" "An unknown field")
expect_status(2 "{\"cases\": []}" "A file of no family")
expect_status(2 "not JSON" "A file that is not JSON")
message(STATUS "reference_check goes red when it must.")
