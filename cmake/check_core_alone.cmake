# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE=<source tree> -D WORK=<folder> -D COMPILER=<C++ compiler> -D GENERATOR=<generator>
#       [-D BUILD=all] -P check_core_alone.cmake
#
# Configures the tree without plugins/; with BUILD it builds that target too, which takes as long as a first build.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}/tree")
file(MAKE_DIRECTORY "${WORK}/tree")
file(GLOB entries RELATIVE "${SOURCE}" "${SOURCE}/*")
foreach(entry IN LISTS entries)
  if(NOT entry MATCHES "^(plugins|build|out)$")
    file(CREATE_LINK "${SOURCE}/${entry}" "${WORK}/tree/${entry}" SYMBOLIC)
  endif()
endforeach()

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "without plugins/, ${what} ended with ${status}:\n${said}")
  endif()
endfunction()
run("configuring" ${CMAKE_COMMAND} -S ${WORK}/tree -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D KERF_TESTS=ON -D CMAKE_BUILD_TYPE=RelWithDebInfo ${LAUNCHER})
if(BUILD)
  run("building" ${CMAKE_COMMAND} --build ${WORK}/build --target ${BUILD} --parallel 2)
endif()
