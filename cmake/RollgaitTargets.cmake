# Compile options of every target of the project, and the two helpers that declare libraries and tests.

# Without it every file is compiled by itself, which shows what leans on the includes of others.
option(ROLLGAIT_UNITY "Compile the files of a target sixteen at a time: a quarter of the time; a change compiles more" OFF)
set(CMAKE_UNITY_BUILD "${ROLLGAIT_UNITY}")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16 CACHE STRING "Files that ROLLGAIT_UNITY compiles at a time")
set(ROLLGAIT_SANITIZE "" CACHE STRING "Sanitizers to build with, for example address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
# What computes, core/ and bench/, has -O3; all else waits for wires and disks, and takes a tenth less to compile. In Debug it has -O1
# where all else may have nothing, which compiles in three fifths of the time.
set(ROLLGAIT_OPTIMISATION -O2 CACHE STRING "In Release, of all that does not compute; -O0 compiles in less than half of the time")
set(CMAKE_CXX_FLAGS_RELEASE "${ROLLGAIT_OPTIMISATION}")
set(ROLLGAIT_COMPUTES "$<$<CONFIG:Release>:-O3>$<$<CONFIG:Debug>:-O1>")

include(X8664V3)

# Headers of protobuf 3.21 lay maps out otherwise where the macro of the thread sanitizer is defined (MapFieldBase in
# google/protobuf/map_field.h), and so other than Debian's library does. The standard library goes on knowing of the sanitizer.
set(ROLLGAIT_THREAD_SANITIZER "")
if(ROLLGAIT_SANITIZE MATCHES "thread")
  set(ROLLGAIT_THREAD_SANITIZER -U__SANITIZE_THREAD__ -D_GLIBCXX_TSAN=1 -DROLLGAIT_THREAD_SANITIZER)
endif()

add_library(rollgait_options INTERFACE)
target_compile_options(rollgait_options INTERFACE -Wall -Wextra -Wshadow -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A tenth of the time to compile goes into collecting garbage below this size, KiB.
  target_compile_options(rollgait_options INTERFACE --param=ggc-min-heapsize=1048576)
endif()
# g++ 12 sees overlapping memory in "literal" + std::string where there is none (GCC bug 105651, fixed in 13).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(rollgait_options INTERFACE -Wno-restrict)
endif()
# g++ 13 and later see small dynamic Eigen vectors read past their end by vector instructions behind a test of the size; g++ 12
# keeps the check.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(rollgait_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow)
endif()
# Later versions of clang than 14 tell of a function that g++ 12's std::stable_sort calls and C++20 deprecates, and take the captures
# that clang 14 needs, [&axes = axes] of a structured binding, for names that hide others.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 15)
  target_compile_options(rollgait_options INTERFACE -Wno-deprecated-declarations -Wno-shadow)
endif()
target_include_directories(rollgait_options INTERFACE "${PROJECT_SOURCE_DIR}")
if(ROLLGAIT_SANITIZE)
  target_compile_options(rollgait_options INTERFACE
    "-fsanitize=${ROLLGAIT_SANITIZE}" -fno-omit-frame-pointer -fno-sanitize-recover=all ${ROLLGAIT_THREAD_SANITIZER})
  target_link_options(rollgait_options INTERFACE "-fsanitize=${ROLLGAIT_SANITIZE}")
  if(ROLLGAIT_SANITIZE MATCHES "address")
    # g++ and clang 14 have no macro in common that tells of it.
    target_compile_definitions(rollgait_options INTERFACE ROLLGAIT_ADDRESS_SANITIZER)
  endif()
  if(ROLLGAIT_SANITIZE MATCHES "undefined")
    # Checks of every reference that double the time to compile. What they would see shows otherwise: the address sanitizer reports
    # a null pointer, or one outside its object, when it is followed, and a misaligned vector access faults by itself.
    target_compile_options(rollgait_options INTERFACE -fno-sanitize=null,alignment,object-size,pointer-overflow)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Instrumented code makes g++ see uninitialised temporaries that are none, and copies of short strings past their end; the
    # Release build keeps these warnings.
    target_compile_options(rollgait_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
  endif()
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  # A read of an uninitialised matrix entry shows up as NaN.
  target_compile_definitions(rollgait_options INTERFACE EIGEN_INITIALIZE_MATRICES_BY_NAN)
endif()

# rollgait_library(NAME base SOURCES a.cc DEPS rollgait::math PRIVATE_DEPS ipopt)
# declares the static library rollgait_<NAME> with the alias rollgait::<NAME>, and its twin for x86-64-v3. SHARED_BY_BUILDS: no twin,
# because no header has a type of Eigen's and no time is spent there.
function(rollgait_library)
  cmake_parse_arguments(ARG "SHARED_BY_BUILDS" "NAME" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(rollgait_${ARG_NAME} STATIC ${ARG_SOURCES})
  add_library(rollgait::${ARG_NAME} ALIAS rollgait_${ARG_NAME})
  target_link_libraries(rollgait_${ARG_NAME} PUBLIC ${ARG_DEPS} PRIVATE $<BUILD_INTERFACE:rollgait_options> ${ARG_PRIVATE_DEPS})
  target_include_directories(rollgait_${ARG_NAME} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:include/rollgait>")
  if(ROLLGAIT_X86_64_V3 AND NOT ARG_SHARED_BY_BUILDS)
    rollgait_library_twin(${ARG_NAME} "${ARG_SOURCES}" "${ARG_DEPS}" "${ARG_PRIVATE_DEPS}")
  endif()
endfunction()

# The longest tests have a property COST, an order of about their seconds: ctest begins with them, so that they are not what is waited
# for at the end.
#
# s; ends a test that hangs, and nothing else: with sanitizers on a busy machine the slowest take minutes.
set(ROLLGAIT_TEST_TIMEOUT 1800)

# Folders of tests that compute with Eigen themselves: those of core whose slowest tests take 4 to 100 times as long without optimisation
# (in Debug, seconds alone: 39, 79, 37 and 123 in place of 3, 1, 2 and 29; goddard_test of known_answers in Release 133 in place of
# 2); others wait for core, and gain a tenth or nothing.
set(ROLLGAIT_NUMERIC_TESTS "^tests/(core/(contact|known_answers|multibody|nlp|transcription)|paper|reference_check)")

# Options of the sources of tests themselves: what they test is in libraries, with all optimisation. Without it, or with little of it
# where they compute, half of their time to compile.
set(ROLLGAIT_TEST_OPTIONS -O0)
set(ROLLGAIT_NUMERIC_TEST_OPTIONS -O1)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # With less inlining g++ sees uninitialised members of variants that are never read; the libraries keep this warning.
  list(APPEND ROLLGAIT_NUMERIC_TEST_OPTIONS "$<$<CONFIG:Release>:-Wno-maybe-uninitialized>")
endif()

# rollgait_test(dual_test.cc DEPS rollgait::base LABELS unit [DEFINITIONS DATA="..."] [NEEDS a_program])
# declares one GoogleTest program per source file; the path below tests/ is its name. NEEDS: programs that it starts.
function(rollgait_test SOURCE)
  rollgait_test_name("${SOURCE}" name)
  rollgait_test_program(${name} ${SOURCE} ${ARGN})
  rollgait_add_test(${name} ${name} "" ${ARGN})
endfunction()

# rollgait_tests(a_test.cc b_test.cc DEPS rollgait::base LABELS unit): the same for several files. With ROLLGAIT_UNITY they are one program,
# <folder>.<label>_tests, compiled together, and each file's test asks it for the suites of that file. The test <program>.all is
# red when the program holds a test that no file's test asks for. WITHOUT Suite.Name...: tests of these files that this build does not run.
function(rollgait_tests)
  cmake_parse_arguments(ARG "" "" "DEPS;LABELS;DEFINITIONS;NEEDS;WITHOUT" ${ARGN})
  set(options DEPS ${ARG_DEPS} LABELS ${ARG_LABELS} DEFINITIONS ${ARG_DEFINITIONS} NEEDS ${ARG_NEEDS})
  list(JOIN ARG_WITHOUT ":" without)
  if(without)
    string(PREPEND without "--gtest_filter=-")
  endif()
  if(NOT ROLLGAIT_UNITY)
    foreach(source ${ARG_UNPARSED_ARGUMENTS})
      rollgait_test_name("${source}" name)
      rollgait_test_program(${name} ${source} ${options})
      rollgait_add_test(${name} ${name} "${without}" ${options})
    endforeach()
    return()
  endif()
  rollgait_test_name(${ARG_LABELS}_tests program)
  set(asked "")
  rollgait_named_copies(copies ${ARG_UNPARSED_ARGUMENTS})
  rollgait_test_program(${program} "${copies}" ${options})
  foreach(source ${ARG_UNPARSED_ARGUMENTS})
    rollgait_test_name("${source}" name)
    set(macro "^(TYPED_)?TEST(_F|_P)?\\(([A-Za-z0-9_]+),.*")
    file(STRINGS "${source}" lines REGEX "${macro}")
    list(TRANSFORM lines REPLACE "${macro}" "\\3")
    list(REMOVE_DUPLICATES lines)
    if(NOT lines)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${source} has no test at the start of a line")
    endif()
    list(TRANSFORM lines REPLACE "(.+)" "\\1.*:*/\\1.*:\\1/*:*/\\1/*")
    list(JOIN lines ":" filter)
    string(REPLACE "--gtest_filter=" "" excluded "${without}")
    rollgait_add_test(${name} ${program} "--gtest_filter=${filter}${excluded}" ${options})
    list(APPEND asked "${filter}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
  endforeach()
  list(JOIN asked ":" asked)
  add_test(NAME ${program}.all COMMAND ${program} --gtest_list_tests "--gtest_filter=-${asked}")
  # gtest lists tests indented below their suites.
  set_tests_properties(${program}.all PROPERTIES LABELS "${ARG_LABELS}" FAIL_REGULAR_EXPRESSION "\n  ")
endfunction()

# Copies of the sources in which each file's anonymous namespace has the file's name, so that files that define the same names can
# be compiled together; compilers and debuggers tell the original's lines.
function(rollgait_named_copies OUT)
  set(copies "")
  foreach(source ${ARGN})
    rollgait_test_name("${source}" name)
    string(MAKE_C_IDENTIFIER "${name}" identifier)
    set(original "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
    set(copy "${CMAKE_CURRENT_BINARY_DIR}/named/${name}.cc")
    file(READ "${original}" text)
    string(REPLACE "\nnamespace {\n" "\nnamespace of_${identifier} {\n" text "${text}")
    set(text "#line 1 \"${original}\"\n${text}")
    set(before "")
    if(EXISTS "${copy}")
      file(READ "${copy}" before)
    endif()
    if(NOT text STREQUAL before)
      file(WRITE "${copy}" "${text}")
    endif()
    list(APPEND copies "${copy}")
  endforeach()
  set(${OUT} "${copies}" PARENT_SCOPE)
endfunction()

# tests/core/base/dual_test.cc: core.base.dual_test
function(rollgait_test_name SOURCE OUT)
  file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}/tests" "${CMAKE_CURRENT_SOURCE_DIR}/${SOURCE}")
  string(REGEX REPLACE "\\.cc$" "" name "${path}")
  string(REPLACE "/" "." name "${name}")
  set(${OUT} "${name}" PARENT_SCOPE)
endfunction()

function(rollgait_test_program TARGET SOURCES)
  cmake_parse_arguments(ARG "" "" "DEPS;LABELS;DEFINITIONS;NEEDS" ${ARGN})
  add_executable(${TARGET} ${SOURCES})
  set_target_properties(${TARGET} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  target_link_libraries(${TARGET} PRIVATE rollgait_options ${ARG_DEPS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${TARGET} PRIVATE ${ARG_DEFINITIONS})
  if(ARG_NEEDS)
    add_dependencies(${TARGET} ${ARG_NEEDS})
  endif()
  if(TARGET thread_tests)
    add_dependencies(thread_tests ${TARGET})
  endif()
endfunction()

# rollgait_finish_targets(DIRECTORY): what a target's folder says of how it is compiled, for every target of the directory and below
# that has the options of the project. Twins for x86-64-v3 have precompiled headers of no kind.
function(rollgait_finish_targets DIRECTORY)
  get_property(folders DIRECTORY "${DIRECTORY}" PROPERTY SUBDIRECTORIES)
  foreach(folder ${folders})
    rollgait_finish_targets("${folder}")
  endforeach()
  file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${DIRECTORY}")
  get_property(targets DIRECTORY "${DIRECTORY}" PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(links ${target} LINK_LIBRARIES)
    if(NOT "${links}" MATCHES "rollgait_options" OR "${links}" MATCHES "rollgait_v3_options" OR target MATCHES "^rollgait_precompiled_")
      continue()
    endif()
    if(path MATCHES "${ROLLGAIT_NUMERIC_TESTS}")
      target_compile_options(${target} PRIVATE ${ROLLGAIT_NUMERIC_TEST_OPTIONS})
    elseif(path MATCHES "^tests")
      target_compile_options(${target} PRIVATE ${ROLLGAIT_TEST_OPTIONS})
    endif()
    rollgait_precompile(${target} "${path}")
  endforeach()
endfunction()

function(rollgait_add_test NAME PROGRAM FILTER)
  cmake_parse_arguments(ARG "" "" "DEPS;LABELS;DEFINITIONS;NEEDS" ${ARGN})
  add_test(NAME ${NAME} COMMAND ${ROLLGAIT_TEST_LAUNCHER} $<TARGET_FILE:${PROGRAM}> ${FILTER})
  set_tests_properties(${NAME} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ROLLGAIT_TEST_TIMEOUT} ENVIRONMENT
    "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/leak_suppressions.txt:print_suppressions=0;UBSAN_OPTIONS=print_stacktrace=1")
endfunction()
