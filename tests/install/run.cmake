# Installs core below WORK, builds examples/library with it as a stranger would, and runs what it makes.
#   cmake -DTREE=<build> -DROOT=<repository> -DWORK=<directory> -DGENERATOR=<of the build> -P tests/install/run.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nexit code ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${TREE}" --prefix "${WORK}/prefix" --component core)
# A copy, so that no header is found beside the example.
file(COPY "${ROOT}/examples/library" DESTINATION "${WORK}")
run("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${WORK}/library" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/one_gait" 10)
if(NOT output MATCHES "speed 1[.]3000 m/s")
  message(FATAL_ERROR "one_gait printed no gait at 1.3 m/s:\n${output}")
endif()
# A request out of range is refused by the library, too.
execute_process(COMMAND "${WORK}/build/one_gait" 80 RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "slope")
  message(FATAL_ERROR "80 degrees gave exit code ${result}: ${output}")
endif()
file(GLOB_RECURSE headers "${WORK}/prefix/*.h")
foreach(header ${headers})
  file(STRINGS "${header}" found REGEX "#include \"(server|client|rollgait|generated)/")
  if(found)
    message(FATAL_ERROR "${header} includes what is not installed: ${found}")
  endif()
endforeach()
