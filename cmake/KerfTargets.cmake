# SPDX-License-Identifier: Apache-2.0
# The few functions every folder uses; kerf_add_plugin() is in KerfPlugin, which is installed, too.

# No path of this machine in what is installed: neither in asserts nor in what a debugger reads.
add_compile_options("-ffile-prefix-map=${CMAKE_SOURCE_DIR}=.")

add_library(kerf_warnings INTERFACE)
add_library(kerf::warnings ALIAS kerf_warnings)
target_compile_options(kerf_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
  # g++ 12 sees overlaps in std::string that are not there, with -O3 only (GCC bug 105651)
  $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-conditional-parentheses>   # branchless `a | b ? 1.0 : 0.0` is meant so
  -ffp-contract=off)   # a fused multiply-add would change a replay

# kerf_add_layer(field SOURCES a.cpp b.h LINKS kerf::sdk)  → kerf::field, seen as "core/field/…"
function(kerf_add_layer name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(kerf_${name} STATIC ${arg_SOURCES})
  add_library(kerf::${name} ALIAS kerf_${name})
  kerf_set_up_library(${name})
  target_link_libraries(kerf_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS} kerf::warnings)
endfunction()

# How a library is seen: from the root of the tree, and where it is installed. What it has in its headers is compiled
# without fused multiply-adds in its users too.
function(kerf_set_up_library name)
  set_target_properties(kerf_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(kerf_${name} PUBLIC cxx_std_20)
  target_compile_options(kerf_${name} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  target_include_directories(kerf_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:include/kerf-run>)
endfunction()
