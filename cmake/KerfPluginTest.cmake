# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM=kerf -D PLUGIN=….so -P KerfPluginTest.cmake
#
# Whether the program loads that very file, lists what it holds and describes it.
cmake_minimum_required(VERSION 3.25)
get_filename_component(file "${PLUGIN}" NAME)

# Alone in a folder, before all others: of two plugins with one id the first is taken.
set(alone "${PLUGIN}.alone")
file(REMOVE_RECURSE "${alone}")
file(COPY "${PLUGIN}" DESTINATION "${alone}")
set(ENV{KERF_PLUGIN_PATH} "${alone}")

# A copy of a plugin of Kerf's own is in another folder than Kerf's.
execute_process(COMMAND ${PROGRAM} list OUTPUT_QUIET ERROR_VARIABLE complaint)
if(complaint MATCHES "`KERF_PLUGIN_ALLOW=(kerf[a-z0-9._]+)`")
  set(ENV{KERF_PLUGIN_ALLOW} "${CMAKE_MATCH_1}")
endif()

function(ask out)
  execute_process(COMMAND ${PROGRAM} ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE complaint)
  string(REPLACE "${alone}/${file} (used)" "" refusal "${complaint}")   # its twin is in the way, not it
  string(FIND "${refusal}" "${alone}/${file}" at)
  if(NOT status EQUAL 0 OR NOT at EQUAL -1)
    message(FATAL_ERROR "`kerf ${ARGN}` does not take ${file}: it ended with ${status} and said\n${complaint}")
  endif()
  set(${out} "${said}" PARENT_SCOPE)
endfunction()

ask(listed list)
# The folder was the first, so what it holds is listed first.
if(NOT listed MATCHES "^[a-z]+ +([A-Za-z0-9_.-]+)[/ ]")
  message(FATAL_ERROR "`kerf list` names nothing of ${file}. It says\n${listed}")
endif()
ask(described describe ${CMAKE_MATCH_1})
message(STATUS "${file} is loaded, listed and described:\n${described}")
file(REMOVE_RECURSE "${alone}")
