# cmake -DSOLVER=<rollgait-solve> -DSPEC=<file> -DOUTPUT=<file> -P make_gait.cmake: one solve, its result as proto3 JSON.
execute_process(COMMAND "${SOLVER}" --spec "${SPEC}" OUTPUT_FILE "${OUTPUT}" ERROR_VARIABLE progress RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "rollgait-solve --spec ${SPEC}: exit code ${code}\n${progress}")
endif()
