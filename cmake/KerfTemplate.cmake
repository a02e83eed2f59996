# SPDX-License-Identifier: Apache-2.0
# cmake -D TOOL=<examples/02_round_burr> -D STRATEGY=<examples/06_groove> -D PROCEDURE=<examples/08_procedure>
#   -D OUT=<header> -P KerfTemplate.cmake
#
# The files of three examples as a C++ header, so that `kerf new` needs nothing but the program.
cmake_minimum_required(VERSION 3.25)
set(header "// Made from examples by KerfTemplate.cmake.\n#pragma once\n\n")
string(APPEND header "namespace kerf::app {\n\nstruct NewFile {\n    const char* name;\n    const char* text;\n};\n")
foreach(kind TOOL STRATEGY PROCEDURE)
  string(TOLOWER ${kind} name)
  string(APPEND header "inline constexpr NewFile new_${name}_files[] = {\n")
  file(GLOB_RECURSE files RELATIVE ${${kind}} ${${kind}}/*)
  foreach(file IN LISTS files)
    file(READ ${${kind}}/${file} text)
    string(APPEND header "{\"${file}\", R\"kerf(${text})kerf\"},\n")
  endforeach()
  string(APPEND header "};\n")
endforeach()
string(APPEND header "\n}  // namespace kerf::app\n")
file(WRITE ${OUT} "${header}")
