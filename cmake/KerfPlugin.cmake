# SPDX-License-Identifier: Apache-2.0
# How a plugin is built, in Kerf's own tree and against an installed Kerf: the same function.
include_guard(GLOBAL)
include(CheckCXXCompilerFlag)
set(KERF_PLUGIN_TEST ${CMAKE_CURRENT_LIST_DIR}/KerfPluginTest.cmake CACHE INTERNAL "")
set(KERF_PLUGIN_MAP ${CMAKE_CURRENT_LIST_DIR}/kerf_plugin.map CACHE INTERNAL "")

# kerf_add_plugin(drilling ENTRY plugin.cpp [SOURCES edge_law.cpp edge_law.h …] [LINKS OpenMeshCore …] [PROCEDURES drill.yaml …]
#                 [ANATOMIES anatomy/femur.yaml …] [ACCEPTANCE drill.csv …] [FOLDER kerf] [COMPONENT program]
#                 [UNCHECKED] [OPTIONAL])
#   → kerf_drilling    the module that the host loads, lib/kerf/kerf_drilling.so where built and where installed
#   → kerf::drilling   SOURCES as a static library, or as an interface library where all of them are headers; tests link it
#   → drilling.loads   a test: `kerf` loads the module and describes it
#   → drilling.check   a test: `kerf check` passes it at level 3; not for a plugin that is UNCHECKED
#   → drilling.accepts.NAME   for each acceptance file NAME.csv a test: the law makes the forces that it holds
#   → drilling.NAME    for each procedure NAME.yaml a test: all of its rehearsals end as they expect
# LINKS: libraries of its sources, which only a plugin with a remeshing strategy should need. COMPONENT: that of its installation.
# FOLDER: below lib; procedures find the modules in `kerf` only. OPTIONAL: `cmake --install` passes over a module that was not
# built. A plugin outside of Kerf's tree is installed where that Kerf is, unless CMAKE_INSTALL_PREFIX says otherwise.
function(kerf_add_plugin name)
  cmake_parse_arguments(arg "UNCHECKED;OPTIONAL" "ENTRY;FOLDER;COMPONENT" "SOURCES;LINKS;PROCEDURES;ANATOMIES;ACCEPTANCE" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_ENTRY)
    message(FATAL_ERROR "kerf_add_plugin(${name}): got \"${arg_UNPARSED_ARGUMENTS}\", need ENTRY, the file with KERF_PLUGIN. "
      "Write kerf_add_plugin(${name} ENTRY plugin.cpp), with SOURCES a.cpp a.h for further files.")
  endif()
  if(NOT arg_FOLDER)
    set(arg_FOLDER kerf)
  endif()

  add_library(kerf_${name} MODULE ${arg_ENTRY})
  target_link_libraries(kerf_${name} PRIVATE kerf::sdk)
  set(parts kerf_${name})
  set(compiled ${arg_SOURCES})
  list(FILTER compiled EXCLUDE REGEX "\\.(h|hpp|hh)$")
  if(compiled)
    add_library(kerf_${name}_parts STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    list(APPEND parts kerf_${name}_parts)
  elseif(arg_SOURCES)
    add_library(kerf_${name}_parts INTERFACE ${arg_SOURCES})
    set(scope INTERFACE)
  endif()
  if(arg_SOURCES)
    add_library(kerf::${name} ALIAS kerf_${name}_parts)
    target_include_directories(kerf_${name}_parts ${scope} ${PROJECT_SOURCE_DIR})
    target_link_libraries(kerf_${name}_parts ${scope} kerf::sdk ${arg_LINKS})
    target_link_libraries(kerf_${name} PRIVATE kerf_${name}_parts)
  endif()
  target_link_libraries(kerf_${name} PRIVATE ${arg_LINKS})

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
  set(folder ${CMAKE_BINARY_DIR}/lib/${arg_FOLDER})
  set_target_properties(kerf_${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${folder})
  target_link_options(kerf_${name} PRIVATE -Wl,--exclude-libs,ALL "-Wl,--version-script=${KERF_PLUGIN_MAP}")
  set_property(TARGET kerf_${name} APPEND PROPERTY LINK_DEPENDS ${KERF_PLUGIN_MAP})

  set(optional)
  if(arg_OPTIONAL)
    set(optional OPTIONAL)
  endif()
  set(component)
  if(arg_COMPONENT)
    set(component COMPONENT ${arg_COMPONENT})
  endif()
  install(TARGETS kerf_${name} LIBRARY DESTINATION lib/${arg_FOLDER} ${component} ${optional})
  install(FILES ${arg_PROCEDURES} DESTINATION share/kerf/procedures)
  foreach(anatomy IN LISTS arg_ANATOMIES)   # a procedure names it from its own folder
    get_filename_component(beside "${anatomy}" DIRECTORY)
    install(FILES ${anatomy} DESTINATION share/kerf/procedures/${beside})
  endforeach()
  # In Kerf's own tree the processor time of each test is limited; an installed Kerf has no limits.
  macro(kerf_limit_test test)
    set(limited)
    if(COMMAND kerf_limited)
      kerf_limited(limited ${test} 240)
    endif()
  endmacro()
  kerf_limit_test(${name}.loads)
  add_test(NAME ${name}.loads
    COMMAND ${limited} ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:kerf::program> -D PLUGIN=$<TARGET_FILE:kerf_${name}>
      -P ${KERF_PLUGIN_TEST})
  if(NOT arg_UNCHECKED)
    kerf_limit_test(${name}.check)
    add_test(NAME ${name}.check COMMAND ${limited} $<TARGET_FILE:kerf::program> check $<TARGET_FILE:kerf_${name}>)
    set_tests_properties(${name}.check PROPERTIES TIMEOUT 1200 LABELS whole)
  endif()
  foreach(file IN LISTS arg_ACCEPTANCE)
    get_filename_component(stem ${file} NAME_WE)
    kerf_limit_test(${name}.accepts.${stem})
    add_test(NAME ${name}.accepts.${stem} COMMAND ${limited} $<TARGET_FILE:kerf::program> check $<TARGET_FILE:kerf_${name}>
      --accept ${CMAKE_CURRENT_SOURCE_DIR}/${file} --differences ${CMAKE_BINARY_DIR}/differences)
    set_tests_properties(${name}.accepts.${stem} PROPERTIES TIMEOUT 1200)
  endforeach()
  foreach(procedure IN LISTS arg_PROCEDURES)
    get_filename_component(stem ${procedure} NAME_WE)
    kerf_limit_test(${name}.${stem})
    add_test(NAME ${name}.${stem} COMMAND ${limited} $<TARGET_FILE:kerf::program> rehearse ${CMAKE_CURRENT_SOURCE_DIR}/${procedure})
    set_tests_properties(${name}.${stem} PROPERTIES ENVIRONMENT KERF_PLUGIN_PATH=${folder} TIMEOUT 1200)
  endforeach()
endfunction()
