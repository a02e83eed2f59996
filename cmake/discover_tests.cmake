# SPDX-License-Identifier: Apache-2.0
# cmake -D TIERS=<what kerf_add_test() says of the program> -D TESTS=<file for ctest> -P discover_tests.cmake
#
# Lists the cases of a GoogleTest program and writes a test for each, under kerf-limit.
cmake_minimum_required(VERSION 3.25)
include(${TIERS})

execute_process(COMMAND ${program} --gtest_list_tests RESULT_VARIABLE status OUTPUT_VARIABLE list ERROR_VARIABLE list)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${program} --gtest_list_tests ended with ${status}:\n${list}")
endif()
string(REGEX REPLACE " *#[^\n]*" "" list "${list}")   # what a parameter is
string(REPLACE ";" "" list "${list}")
string(REPLACE "\n" ";" lines "${list}")

# `Suite.*` as a regular expression.
function(to_regex out glob)
  string(REPLACE "." "\\." regex "${glob}")
  string(REPLACE "*" ".*" regex "${regex}")
  set(${out} "^${regex}$" PARENT_SCOPE)
endfunction()

set(script "")
set(known)   # patterns that matched something
set(dear)    # filters of what --quick leaves out

function(add name filter)
  set(labels " LABELS case")
  set(skip " SKIP_REGULAR_EXPRESSION \"\\\\[  SKIPPED \\\\]\"")
  if(filter MATCHES "\\*")   # one skipped case says nothing about the others
    set(skip "")
  endif()
  set(limit_s ${cpu})
  set(more "")
  foreach(pattern IN LISTS whole)
    to_regex(regex "${pattern}")
    if(name MATCHES "${regex}")
      set(labels " LABELS \"case;whole\"")
      set(limit_s ${whole_cpu})
      list(APPEND known "${pattern}")
      list(APPEND dear "${filter}")
    endif()
  endforeach()
  set(fixtures)
  foreach(entry IN LISTS judged)
    string(REGEX MATCH "^([^=]+)=(.*)$" ignored "${entry}")
    set(pattern "${CMAKE_MATCH_1}")
    string(REPLACE "," ";" these "${CMAKE_MATCH_2}")
    to_regex(regex "${pattern}")
    if(name MATCHES "${regex}")
      list(APPEND known "${pattern}")
      list(TRANSFORM these PREPEND "operation/")
      list(APPEND fixtures ${these})
    endif()
  endforeach()
  if(fixtures)
    set(labels " LABELS \"case;whole\"")
    set(limit_s ${whole_cpu})
    list(APPEND dear "${filter}")
    set(more " FIXTURES_REQUIRED \"${fixtures}\" ENVIRONMENT [==[KERF_OPERATIONS=${operations}]==]")
  endif()
  string(APPEND script
    "add_test([==[${name}]==] [==[${limit}]==] --name [==[${name}]==] --cpu ${limit_s} -- [==[${program}]==] [==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${name}]==] PROPERTIES TIMEOUT ${timeout}${skip}${labels}${more})\n")
  set(script "${script}" PARENT_SCOPE)
  set(known "${known}" PARENT_SCOPE)
  set(dear "${dear}" PARENT_SCOPE)
endfunction()

set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ].*)\\.$")
    set(suite "${CMAKE_MATCH_1}")
    if(suite IN_LIST together)
      list(APPEND known "${suite}")
      add("${suite}" "${suite}.*")
    endif()
  elseif(line MATCHES "^  ([^ ]+)$" AND NOT suite IN_LIST together)
    set(name "${suite}.${CMAKE_MATCH_1}")
    if(NOT name MATCHES "DISABLED_")
      add("${name}" "${name}")
    endif()
  endif()
endforeach()

# All that is not dear in one process, for --quick: to start a process for each case takes longer than most cases.
list(REMOVE_DUPLICATES dear)
list(JOIN dear ":" left_out)
get_filename_component(name ${program} NAME)
string(APPEND script
  "add_test([==[quick.${name}]==] [==[${limit}]==] --name quick.${name} --cpu ${whole_cpu} -- [==[${program}]==] [==[--gtest_filter=-${left_out}]==])\n"
  "set_tests_properties([==[quick.${name}]==] PROPERTIES TIMEOUT ${timeout} LABELS quick)\n")

# A tier of a test that was renamed is a mistake: it would silently run in the wrong one.
foreach(pattern IN LISTS whole together)
  if(NOT pattern IN_LIST known)
    message(FATAL_ERROR "${program} has no test `${pattern}`, which its CMakeLists.txt names under WHOLE or TOGETHER")
  endif()
endforeach()
foreach(entry IN LISTS judged)
  string(REGEX REPLACE "=.*" "" pattern "${entry}")
  if(NOT pattern IN_LIST known)
    message(FATAL_ERROR "${program} has no test `${pattern}`, which its CMakeLists.txt names by kerf_judge()")
  endif()
endforeach()
file(WRITE ${TESTS} "${script}")
