# SPDX-License-Identifier: Apache-2.0
# cmake -D FOLDER=<examples/02_round_burr> -D OUT=<header> -P KerfTemplate.cmake
#
# The files of an example as a C++ header, so that `kerf new plugin` needs nothing but the program.
cmake_minimum_required(VERSION 3.25)
set(header "// Made from ${FOLDER} by KerfTemplate.cmake.\n#pragma once\n\n")
string(REGEX REPLACE "^.*/(examples/)" "\\1" shown "${FOLDER}")
string(REPLACE "${FOLDER}" "${shown}" header "${header}")
string(APPEND header "namespace kerf {\n\nstruct NewPluginFile {\n    const char* name;\n    const char* text;\n};\n")
string(APPEND header "inline constexpr NewPluginFile new_plugin_files[] = {\n")
file(GLOB files RELATIVE ${FOLDER} ${FOLDER}/*)
foreach(file IN LISTS files)
  file(READ ${FOLDER}/${file} text)
  string(APPEND header "{\"${file}\", R\"kerf(${text})kerf\"},\n")
endforeach()
string(APPEND header "};\n\n}  // namespace kerf\n")
file(WRITE ${OUT} "${header}")
