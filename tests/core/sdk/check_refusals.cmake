# SPDX-License-Identifier: Apache-2.0
# cmake -D COMPILER=g++ -D SOURCE=<tree> -P check_refusals.cmake
#
# Compiles refusals.cpp once for each mistake in it: without one it must compile, with one the compiler must refuse it and
# name the mistake.
cmake_minimum_required(VERSION 3.25)
set(command ${COMPILER} -std=c++20 -fsyntax-only -I ${SOURCE}/core/sdk/include)
set(file ${SOURCE}/tests/core/sdk/refusals.cpp)

execute_process(COMMAND ${command} ${file} RESULT_VARIABLE status ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "refusals.cpp does not compile without a mistake:\n${output}")
endif()

file(STRINGS ${file} cases REGEX "^#if MISTAKE == [0-9]+  // .*")
foreach(case IN LISTS cases)
  string(REGEX MATCH "MISTAKE == ([0-9]+)  // (.*)$" ignored "${case}")
  set(number ${CMAKE_MATCH_1})
  set(expected "${CMAKE_MATCH_2}")
  execute_process(COMMAND ${command} -D MISTAKE=${number} ${file} RESULT_VARIABLE status ERROR_VARIABLE output)
  string(FIND "${output}" "${expected}" at)
  if(status EQUAL 0)
    message(SEND_ERROR "mistake ${number} compiles; the compiler should say: ${expected}")
  elseif(at EQUAL -1)
    message(SEND_ERROR "mistake ${number} is refused without the words: ${expected}\n${output}")
  endif()
endforeach()
list(LENGTH cases count)
message(STATUS "${count} mistakes are refused by name")
