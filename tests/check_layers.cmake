# Reads every #include under core/, server/ and client/ and fails on one that the tables below do not allow.
#   cmake -DROOT=<repository> -P tests/check_layers.cmake
# The tables are the law; docs/explanation/life_of_a_request.md says why the house is built this way.

cmake_minimum_required(VERSION 3.25)
if(NOT IS_DIRECTORY "${ROOT}")
  message(FATAL_ERROR "Say where the repository is: cmake -DROOT=<repository> -P ${CMAKE_CURRENT_LIST_FILE}")
endif()

# What a layer may include besides itself. Not in the list: not allowed, so every edge points one way.
set(CORE_LAYERS base math geometry multibody nlp contact simulation models ocp trajectory transcription validation gait)
set(core_base)
set(core_math base)
set(core_geometry base math)
set(core_multibody base math)
set(core_nlp base math)  # knows no physics
set(core_contact base math geometry multibody)
set(core_simulation base math geometry multibody contact)  # knows no model and no optimisation
set(core_models base math geometry multibody contact)
set(core_ocp base math geometry multibody contact)
set(core_trajectory base math geometry multibody contact models ocp)
set(core_transcription base math geometry multibody contact ocp trajectory nlp)
set(core_validation base math geometry multibody contact models ocp trajectory)  # judges: no transcription, no nlp
set(core_gait base math geometry multibody nlp contact models ocp trajectory transcription validation)

# The same for the parts of the server; "core" stands for core/, "proto" for the generated headers. Result and the
# contract checks of core/base are common property of the server.
set(SERVER_PARTS base convert store access service rpc agent solve simulate gateway)
set(server_base proto)
set(server_convert base proto core)
set(server_store convert base proto)
set(server_access store base)  # knows no gRPC
set(server_service access store convert base proto core)
set(server_rpc service access simulate store convert base proto)
set(server_agent store convert base proto)
set(server_solve convert base proto core)
set(server_gateway base proto)  # a client of rollgaitd
set(server_simulate agent convert base proto core)  # agent: the child process and its stream

# Headers with few friends: the pattern of what is written in the #include, then the pattern of the files that may.
set(RESTRICTED
  "^(coin/|coin-or/)?Ip[A-Z][A-Za-z]*[.]hpp$"  "^core/nlp/ipopt_solver[.]cc$"
  "^core/gait/optimizing_gait_solver[.]h$"     "^(core/gait/optimizing_gait_solver[.]cc|server/solve/.*)$"
  "^(grpc|grpcpp)/|[.]grpc[.]pb[.]h$"          "^(server/rpc/.*|server/gateway/.*|server/main[.]cc|client/.*)$"
  "^(google|rollgait)/.*[.]pb[.]h$|^google/"   "^(server|client)/"
  "^spdlog/"                                   "^server/"
  "^prometheus/"                               "^server/"
  "^sqlite3[.]h$"                              "^server/store/"
  "^CLI/"                                      "^(client/.*|server/.*main[.]cc|server/base/.*)$")

set(errors "")

# Checks one edge; sets `problem` in the caller to a sentence, or to nothing.
function(check_edge file header)
  set(problem "" PARENT_SCOPE)
  set(patterns ${RESTRICTED})
  while(patterns)
    list(POP_FRONT patterns what who)
    if(header MATCHES "${what}" AND NOT file MATCHES "${who}")
      set(problem "only files matching ${who} may include it" PARENT_SCOPE)
      return()
    endif()
  endwhile()

  # Where the file lives.
  string(REGEX MATCH "^(core|server|client)/" house "${file}")
  string(REPLACE "/" "" house "${house}")
  set(part "")
  if(file MATCHES "^${house}/([^/]+)/")
    set(part "${CMAKE_MATCH_1}")
  endif()
  # What the header belongs to.
  if(header MATCHES "^(core|server|client|tests|bench)/(.*)$")
    set(target_house "${CMAKE_MATCH_1}")
    set(target_part "")
    if(CMAKE_MATCH_2 MATCHES "^([^/]+)/")
      set(target_part "${CMAKE_MATCH_1}")
    endif()
  elseif(header MATCHES "^(rollgait|google)/.*[.]pb[.]h$")
    set(target_house proto)
  elseif(header MATCHES "^[.]|^[^/]*[.]h$" AND NOT header STREQUAL "sqlite3.h")
    set(problem "includes are written from the repository root" PARENT_SCOPE)
    return()
  else()
    return()  # a library; RESTRICTED has spoken
  endif()

  if(target_house MATCHES "^(tests|bench)$")
    set(problem "the product does not include ${target_house}/" PARENT_SCOPE)
  elseif(house STREQUAL "core")
    if(NOT part IN_LIST CORE_LAYERS)
      set(problem "core/${part} is not a layer of the table" PARENT_SCOPE)
    elseif(NOT target_house STREQUAL "core")
      set(problem "core knows no ${target_house}" PARENT_SCOPE)
    elseif(NOT target_part STREQUAL part AND NOT target_part IN_LIST core_${part})
      set(problem "core/${part} may include: ${core_${part}}" PARENT_SCOPE)
    endif()
  elseif(house STREQUAL "server")
    if(target_house STREQUAL "client")
      set(problem "the server knows no client" PARENT_SCOPE)
    elseif(part STREQUAL "" OR header MATCHES "^core/base/")
      # server/main.cc builds every object.
    elseif(NOT part IN_LIST SERVER_PARTS)
      set(problem "server/${part} is not a part of the table" PARENT_SCOPE)
    elseif(target_house STREQUAL "server")
      if(NOT target_part STREQUAL part AND NOT target_part IN_LIST server_${part})
        set(problem "server/${part} may include: ${server_${part}}" PARENT_SCOPE)
      endif()
    elseif(NOT target_house IN_LIST server_${part})
      set(problem "server/${part} may include: ${server_${part}}" PARENT_SCOPE)
    endif()
  elseif(NOT target_house MATCHES "^(client|proto)$" AND NOT header STREQUAL "core/base/nearest_word.h")
    set(problem "the client includes client/, the generated headers and core/base/nearest_word.h only" PARENT_SCOPE)
  endif()
endfunction()

file(GLOB_RECURSE files RELATIVE "${ROOT}"
  "${ROOT}/core/*.h" "${ROOT}/core/*.cc" "${ROOT}/server/*.h" "${ROOT}/server/*.cc" "${ROOT}/client/*.h" "${ROOT}/client/*.cc")
list(LENGTH files file_count)
if(file_count EQUAL 0)
  message(FATAL_ERROR "No source file under '${ROOT}': pass the repository as -DROOT=...")
endif()
set(edge_count 0)
foreach(file ${files})
  file(STRINGS "${ROOT}/${file}" includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  foreach(line ${includes})
    math(EXPR edge_count "${edge_count} + 1")
    string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*([<\"])([^>\"]*)[>\"].*$" "\\2" header "${line}")
    if(line MATCHES "<[^>/]*[.]h>" AND NOT header STREQUAL "sqlite3.h")
      continue()  # a header of the system
    endif()
    check_edge("${file}" "${header}")
    if(problem)
      list(APPEND errors "${file}: ${header}: ${problem}")
    endif()
  endforeach()
endforeach()

if(errors)
  list(JOIN errors "\n  " text)
  message(FATAL_ERROR "Includes that the layers do not allow:\n  ${text}")
endif()
message(STATUS "${edge_count} includes in ${file_count} files keep to the layers.")
