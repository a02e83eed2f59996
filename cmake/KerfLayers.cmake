# SPDX-License-Identifier: Apache-2.0
# Who may know whom, checked twice: here, when configuring, and in every build of ALL, because an #include can be
# added without CMake noticing. The rules are in check_layers.cmake.
set(kerf_check_layers ${CMAKE_COMMAND} -D ROOT=${CMAKE_CURRENT_SOURCE_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/check_layers.cmake)

execute_process(COMMAND ${kerf_check_layers} RESULT_VARIABLE kerf_layers_status)
if(NOT kerf_layers_status EQUAL 0)
  message(FATAL_ERROR "a folder knows what it must not know; the lines above say where")
endif()

add_custom_target(kerf_layers ALL COMMAND ${kerf_check_layers} COMMENT "Checking who includes whom" VERBATIM)
