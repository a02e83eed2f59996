# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE=<source tree> -D WORK=<folder> -D COMPILER=<C++ compiler> -D GENERATOR=<generator> -D WHAT=core|program
#       [-D BUILD=all] -P check_alone.cmake
#
# Configures a part of the tree: `core` and its tests, or all that the program needs, which is everything but plugins/.
# With BUILD it builds that target too, which takes as long as a first build.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}/tree")
file(MAKE_DIRECTORY "${WORK}/tree")
file(GLOB entries RELATIVE "${SOURCE}" "${SOURCE}/*")
foreach(entry IN LISTS entries)
  if(WHAT STREQUAL "core" AND IS_DIRECTORY "${SOURCE}/${entry}" AND NOT entry MATCHES "^(core|tests|cmake)$")
    continue()
  endif()
  if(NOT entry MATCHES "^(plugins|build|out)$")
    file(CREATE_LINK "${SOURCE}/${entry}" "${WORK}/tree/${entry}" SYMBOLIC)
  endif()
endforeach()

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${WHAT} alone: ${what} ended with ${status}:\n${said}")
  endif()
endfunction()
run("configuring" ${CMAKE_COMMAND} -S ${WORK}/tree -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D KERF_TESTS=ON -D CMAKE_BUILD_TYPE=RelWithDebInfo ${LAUNCHER})
if(BUILD)
  run("building" ${CMAKE_COMMAND} --build ${WORK}/build --target ${BUILD} --parallel 2)
endif()
