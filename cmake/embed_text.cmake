# SPDX-License-Identifier: Apache-2.0
# cmake -D INPUT=<file> -D OUTPUT=<file.cpp> -D NAME=<namespace>::<variable> -P embed_text.cmake
#
# Writes a source that defines NAME with the bytes of INPUT. They are listed one by one: compilers limit the
# length of a string literal, and not that of an array.
cmake_minimum_required(VERSION 3.25)

file(READ "${INPUT}" bytes HEX)
if(bytes STREQUAL "")
  message(FATAL_ERROR "${INPUT} is empty: there is nothing to embed")
endif()
string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
string(REPEAT "......." 16 sixteen)
string(REGEX REPLACE "(${sixteen})" "\\1\n" bytes "${bytes}")
get_filename_component(input_name "${INPUT}" NAME)
string(REGEX MATCH "^(.*)::([^:]+)$" matched "${NAME}")
set(namespace "${CMAKE_MATCH_1}")
set(variable "${CMAKE_MATCH_2}")

file(WRITE "${OUTPUT}" "// Made from ${input_name} by embed_text.cmake.
#include <string_view>

namespace ${namespace} {
namespace {
constexpr char bytes[] = {
${bytes}};
}  // namespace

extern const std::string_view ${variable};
constinit const std::string_view ${variable}(bytes, sizeof bytes);

}  // namespace ${namespace}
")
