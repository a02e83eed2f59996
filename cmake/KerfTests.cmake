# SPDX-License-Identifier: Apache-2.0
# How tests are made known to ctest. Each runs under kerf-limit (tests/limit), which counts its processor time.
#
# Tiers, by labels. `whole`: runs a whole operation or takes more than some seconds; `./dev test --quick` leaves it out.
# `case`: one case of a GoogleTest program. `quick`: all cases of a program that are not whole, in one process, which
# `./dev test --quick` runs in place of them.
set(KERF_TEST_CPU 60)          # [s] of processor time that a test may use
set(KERF_WHOLE_TEST_CPU 240)   # [s] one with the label `whole`
set(KERF_TEST_TIMEOUT 3000)    # [s] of wall time: kerf-limit ends a test long before
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=")   # ten times slower
  set(KERF_TEST_CPU 600)
  set(KERF_WHOLE_TEST_CPU 2400)
  set(KERF_TEST_TIMEOUT 30000)
endif()

# kerf_limited(out NAME CPU)  → the words that precede a test's command
function(kerf_limited out name cpu)
  set(${out} $<TARGET_FILE:kerf-limit> --name ${name} --cpu ${cpu} -- PARENT_SCOPE)
endfunction()

# kerf_test(house.prose [WHOLE] [SKIPS] [CPU 60] [ENVIRONMENT A=b] COMMAND …)  → one test that is a command
# SKIPS: it may print "skipped:" and why, and then counts as skipped.
function(kerf_test name)
  cmake_parse_arguments(arg "WHOLE;SKIPS" "CPU" "COMMAND;ENVIRONMENT;PROPERTIES" ${ARGN})
  set(labels)
  set(cpu ${KERF_TEST_CPU})
  if(arg_WHOLE)
    set(labels LABELS whole)
    set(cpu ${KERF_WHOLE_TEST_CPU})
  endif()
  if(arg_CPU)
    set(cpu ${arg_CPU})
  endif()
  set(skip)
  if(arg_SKIPS)
    set(skip SKIP_REGULAR_EXPRESSION "skipped:")
  endif()
  kerf_limited(limited ${name} ${cpu})
  add_test(NAME ${name} COMMAND ${limited} ${arg_COMMAND})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${KERF_TEST_TIMEOUT} ${skip} ${labels} ${arg_PROPERTIES})
  if(arg_ENVIRONMENT)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "${arg_ENVIRONMENT}")
  endif()
endfunction()

# kerf_add_test(field_test SOURCES a_test.cpp LINKS kerf::field [WHOLE Amputation.* …] [TOGETHER Schema …])
#   → a program, and a test `Suite.Case` for each of its cases
# WHOLE: cases with the label `whole`. TOGETHER: suites that are one test, as their cases share
# what is expensive to make; `Group=Suite.*:Other.Case` is one test `Group` of the cases that match.
function(kerf_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;WHOLE;TOGETHER" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} dep::gtest kerf::warnings)
  target_compile_definitions(${name} PRIVATE KERF_SOURCE_DIR="${CMAKE_SOURCE_DIR}" KERF_BUILD_DIR="${CMAKE_BINARY_DIR}")
  add_dependencies(${name} kerf-limit)

  set_target_properties(${name} PROPERTIES KERF_WHOLE "${arg_WHOLE}" KERF_TOGETHER "${arg_TOGETHER}")
  set(tiers ${CMAKE_CURRENT_BINARY_DIR}/${name}_tiers.cmake)
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${name}_tests.cmake)
  file(GENERATE OUTPUT ${tiers} CONTENT
"set(program [[$<TARGET_FILE:${name}>]])
set(limit [[$<TARGET_FILE:kerf-limit>]])
set(cpu ${KERF_TEST_CPU})
set(whole_cpu ${KERF_WHOLE_TEST_CPU})
set(timeout ${KERF_TEST_TIMEOUT})
set(operations [[${CMAKE_BINARY_DIR}/operations]])
set(whole [[$<TARGET_PROPERTY:${name},KERF_WHOLE>]])
set(together [[$<TARGET_PROPERTY:${name},KERF_TOGETHER>]])
set(judged [[$<TARGET_PROPERTY:${name},KERF_JUDGED>]])
")
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D TIERS=${tiers} -D TESTS=${tests} -P ${CMAKE_SOURCE_DIR}/cmake/discover_tests.cmake
    VERBATIM)
  # The tests are listed again when their tiers change.
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${tiers} ${CMAKE_SOURCE_DIR}/cmake/discover_tests.cmake)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests}.in)
  file(WRITE ${tests}.in "if(EXISTS \"${tests}\")\n  include(\"${tests}\")\nelse()\n  add_test(${name}_NOT_BUILT ${name})\nendif()\n")
endfunction()

# kerf_add_operation(pedicle-screw expert)  → a ctest fixture, `operation/pedicle-screw/expert`: a test that runs the
# rehearsal of procedures/pedicle-screw.yaml once and leaves its session in build/…/operations.
function(kerf_add_operation procedure rehearsal)
  set(id ${procedure}/${rehearsal})
  set_property(GLOBAL APPEND PROPERTY KERF_OPERATIONS ${id})
  kerf_test(operation/${id} WHOLE
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:kerf> -D FOLDER=${CMAKE_BINARY_DIR}/operations/${id}
      -P ${CMAKE_SOURCE_DIR}/cmake/record_operation.cmake -- run ${CMAKE_SOURCE_DIR}/procedures/${procedure}.yaml
      --hand ${rehearsal}
    PROPERTIES FIXTURES_SETUP operation/${id} COST 100)
endfunction()

# kerf_judge(app_test PedicleScrew.* pedicle-screw/expert …)  → these cases read the sessions of these operations
# The operations are added before.
function(kerf_judge test pattern)
  get_property(known GLOBAL PROPERTY KERF_OPERATIONS)
  foreach(operation IN LISTS ARGN)
    if(NOT operation IN_LIST known)
      message(FATAL_ERROR "kerf_judge(${test} ${pattern}): there is no operation ${operation}. Add it to tests/operations.")
    endif()
  endforeach()
  list(JOIN ARGN "," operations)
  set_property(TARGET ${test} APPEND PROPERTY KERF_JUDGED "${pattern}=${operations}")
endfunction()

# kerf_add_animals(kerf_zoo "" ${CMAKE_BINARY_DIR}/zoo animal saint draws_random_numbers …)
#   → plugins out of one source, each with the fault that it is named after, and built with the target
set(kerf_animal_name ${CMAKE_SOURCE_DIR}/tests/animals/animal_name.cpp)
function(kerf_add_animals target prefix folder body)
  add_library(${body} OBJECT ${body}.cpp)
  target_link_libraries(${body} PRIVATE kerf::sdk)
  target_include_directories(${body} PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_options(${body} PRIVATE -ffp-contract=off -fno-gnu-unique)
  set_target_properties(${body} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  foreach(how IN LISTS ARGN)
    add_library(${prefix}${how} MODULE ${kerf_animal_name} $<TARGET_OBJECTS:${body}>)
    target_compile_definitions(${prefix}${how} PRIVATE KERF_HOW="${how}")
    set_target_properties(${prefix}${how} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${folder})
    target_link_options(${prefix}${how} PRIVATE "-Wl,--version-script=${KERF_PLUGIN_MAP}")
    add_dependencies(${target} ${prefix}${how})
  endforeach()
endfunction()

# kerf_add_doubles(dhd libdrd .so.3)
#   → kerf_double_dhd_new and kerf_double_dhd_old, stand-ins for a maker's library, of double_dhd.cpp. A driver opens
#     them by the same path as the real one. Without SONAME, one that is loaded is not found by its name alone.
function(kerf_add_doubles name output suffix)
  string(TOUPPER ${name} upper)
  foreach(version new old)
    set(target kerf_double_${name}_${version})
    add_library(${target} SHARED double_${name}.cpp double_${name}.h)
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${target} PRIVATE kerf::warnings)
    target_compile_features(${target} PRIVATE cxx_std_20)
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${output} SUFFIX ${suffix} NO_SONAME ON
      LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/doubles/${name}_${version} CXX_VISIBILITY_PRESET default)
  endforeach()
  target_compile_definitions(kerf_double_${name}_old PRIVATE DOUBLE_${upper}_IS_OLD)
endfunction()
