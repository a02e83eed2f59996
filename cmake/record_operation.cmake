# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM=kerf -D FOLDER=… -P record_operation.cmake -- run P.yaml --hand H
#
# Runs an operation for the tests that judge it. FOLDER then has its files; FOLDER.out what it printed, FOLDER.status its
# exit code. Passed or not is for the tests to judge; only a run that could not be made is a failure.
cmake_minimum_required(VERSION 3.25)
set(words)
set(is_command FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(is_command)
    list(APPEND words "${CMAKE_ARGV${i}}")
  elseif(CMAKE_ARGV${i} STREQUAL "--")
    set(is_command TRUE)
  endif()
endforeach()
file(REMOVE_RECURSE ${FOLDER})   # nothing of an earlier run of the tests is read
get_filename_component(parent ${FOLDER} DIRECTORY)
file(MAKE_DIRECTORY ${parent})
execute_process(COMMAND ${PROGRAM} ${words} --out ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE printed
  ERROR_VARIABLE complaint)
if(NOT status MATCHES "^[01]$")
  file(REMOVE_RECURSE ${FOLDER})
  message(FATAL_ERROR "${words} ended with ${status}:\n${printed}${complaint}")
endif()
file(WRITE ${FOLDER}.out "${printed}")
file(WRITE ${FOLDER}.status "${status}")
