# SPDX-License-Identifier: Apache-2.0
# How a plugin is built, in Kerf's own tree and against an installed Kerf: the same function.
include_guard(GLOBAL)
include(CheckCXXCompilerFlag)
set(KERF_PLUGIN_TEST ${CMAKE_CURRENT_LIST_DIR}/KerfPluginTest.cmake CACHE INTERNAL "")

# kerf_add_plugin(drilling SOURCES edge_law.cpp edge_law.h ENTRY plugin.cpp [PROCEDURES peck.yaml …] [FOLDER kerf])
#   → kerf_drilling    the module that the host loads, lib/kerf/kerf_drilling.so where built and where installed
#   → kerf::drilling   all but the entry, a static library that tests may link
#   → drilling.loads   a test: `kerf` loads the module and describes it
# ENTRY may be left out: then SOURCES hold the entry, too. FOLDER: below lib; procedures find those in `kerf` only.
function(kerf_add_plugin name)
  cmake_parse_arguments(arg "" "ENTRY;FOLDER" "SOURCES;PROCEDURES" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "kerf_add_plugin(${name}): got \"${arg_UNPARSED_ARGUMENTS}\", need SOURCES. Write kerf_add_plugin(${name} SOURCES a.cpp a.h ENTRY plugin.cpp).")
  endif()
  if(NOT arg_FOLDER)
    set(arg_FOLDER kerf)
  endif()
  if(arg_ENTRY)
    add_library(kerf_${name}_parts STATIC ${arg_SOURCES})
    add_library(kerf::${name} ALIAS kerf_${name}_parts)
    add_library(kerf_${name} MODULE ${arg_ENTRY})
    target_include_directories(kerf_${name}_parts PUBLIC ${CMAKE_SOURCE_DIR})
    target_link_libraries(kerf_${name}_parts PUBLIC kerf::sdk)
    target_link_libraries(kerf_${name} PRIVATE kerf_${name}_parts)
    set(parts kerf_${name}_parts kerf_${name})
  else()
    add_library(kerf_${name} MODULE ${arg_SOURCES})
    target_link_libraries(kerf_${name} PRIVATE kerf::sdk)
    set(parts kerf_${name})
  endif()

  check_cxx_compiler_flag(-fno-gnu-unique KERF_COMPILER_HAS_NO_GNU_UNIQUE)
  foreach(part IN LISTS parts)
    target_compile_features(${part} PUBLIC cxx_std_20)
    # A fused multiply-add would change a replay; a path of this machine belongs in no file that is installed.
    target_compile_options(${part} PRIVATE -ffp-contract=off "-ffile-prefix-map=${CMAKE_SOURCE_DIR}=.")
    if(KERF_COMPILER_HAS_NO_GNU_UNIQUE)
      target_compile_options(${part} PRIVATE -fno-gnu-unique)   # else the module could never be unloaded
    endif()
    set_target_properties(${part} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
      CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    if(TARGET kerf::warnings)
      target_link_libraries(${part} PRIVATE kerf::warnings)
    endif()
  endforeach()
  set_target_properties(kerf_${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/${arg_FOLDER})
  target_link_options(kerf_${name} PRIVATE -Wl,--exclude-libs,ALL)

  install(TARGETS kerf_${name} LIBRARY DESTINATION lib/${arg_FOLDER})
  if(arg_PROCEDURES)
    install(FILES ${arg_PROCEDURES} DESTINATION share/kerf/procedures)
  endif()
  add_test(NAME ${name}.loads
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:kerf::program> -D PLUGIN=$<TARGET_FILE:kerf_${name}> -P ${KERF_PLUGIN_TEST})
endfunction()
