# SPDX-License-Identifier: Apache-2.0
# cmake -D BUILD=<build tree> -D SOURCE=<source tree> -D COMPILERS=clang++,g++ -D USED=<that of the tree> -D WORK=<folder> -P check_install.cmake
#
# Installs Kerf below a prefix of its own, moves that prefix, and uses it as somebody else would: no file of it names a path of
# this machine, the program finds plugins and procedures from where it is, and every plugin is built as a project of its own by
# another compiler than the tree's.
cmake_minimum_required(VERSION 3.25)

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} ended with ${status}:\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("cmake --install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/kerf)   # a prefix may be moved

file(GLOB_RECURSE files LIST_DIRECTORIES false ${WORK}/kerf/*)
foreach(file IN LISTS files)
  file(STRINGS "${file}" lines)
  foreach(path "${SOURCE}/" "${BUILD}/" "${WORK}/")
    string(FIND "${lines}" "${path}" at)
    if(NOT at EQUAL -1)
      message(SEND_ERROR "${file} names ${path}. Installed files must find the rest from where they are.")
    endif()
  endforeach()
endforeach()

set(program ${WORK}/kerf/bin/kerf)
unset(ENV{KERF_PLUGIN_PATH})
run("kerf list" ${program} list)
message(STATUS "installed, `kerf list` says\n${said}")
file(MAKE_DIRECTORY ${WORK}/elsewhere)
run("kerf validate" ${CMAKE_COMMAND} -E chdir ${WORK}/elsewhere ${program} validate pedicle-screw.yaml)

# By component, as the Debian packages have it. Without the module under the GPL one error names the package to install, and
# the run goes on; with it there is none.
foreach(component program remesh_cgal)
  run("cmake --install --component ${component}" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/parts --component ${component})
  execute_process(COMMAND ${WORK}/parts/bin/kerf run ${SOURCE}/tests/golden/E0718.yaml --out ${WORK}/elsewhere/${component}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE complaint)
  string(REGEX MATCHALL "E0718 [^\n]*" errors "${said}${complaint}")
  list(LENGTH errors count)
  set(expected 0)
  if(component STREQUAL "program")
    set(expected 1)
  endif()
  if(NOT (count EQUAL expected AND (expected EQUAL 0 OR errors MATCHES "Install the package `kerf-remesh-cgal`")
      AND said MATCHES "verdict: "))
    message(FATAL_ERROR "with the components up to ${component}, `kerf run` ended with ${status} and printed\n${said}${complaint}\n"
      "Without remesh_cgal it must print one E0718 that names the package kerf-remesh-cgal, and a verdict; with it no E0718.")
  endif()
endforeach()
foreach(file man/man1/kerf.1 bash-completion/completions/kerf zsh/site-functions/_kerf fish/vendor_completions.d/kerf.fish
    kerf/system/70-kerf.rules kerf/system/90-kerf.conf ../lib/udev/rules.d/70-kerf.rules)
  if(NOT EXISTS ${WORK}/parts/share/${file})
    message(FATAL_ERROR "the component program does not install share/${file}. See app/CMakeLists.txt.")
  endif()
endforeach()
if(EXISTS ${WORK}/parts/include)
  message(FATAL_ERROR "the components program and remesh_cgal install headers. Add COMPONENT sdk to their rule.")
endif()

# The compilers that are here; the first that is not the tree's own builds Kerf's plugins.
string(REPLACE "," ";" COMPILERS "${COMPILERS}")
file(REAL_PATH "${USED}" used)
set(found_compilers)
foreach(compiler IN LISTS COMPILERS)
  find_program(found ${compiler} NO_CACHE)
  if(found)
    list(APPEND found_compilers "${found}")
    file(REAL_PATH "${found}" real)
    if(NOT real STREQUAL used AND NOT other)
      set(other "${found}")
    endif()
  endif()
  unset(found)
endforeach()
if(NOT other)
  message(STATUS "skipped: no compiler here but ${USED}. Install clang (or g++): it builds plugins as projects of their own.")
  return()
endif()

# Configures, builds and tests a project against the installed Kerf; what that printed is in `log`.
function(build_and_test what folder build compiler)
  run("configuring ${what}" ${CMAKE_COMMAND} -S ${folder} -B ${build} -D CMAKE_CXX_COMPILER=${compiler}
    -D CMAKE_PREFIX_PATH=${WORK}/kerf)
  set(log "${said}")
  run("building ${what}" ${CMAKE_COMMAND} --build ${build} --parallel 2)
  string(APPEND log "${said}")
  if(said MATCHES "warning:")
    message(FATAL_ERROR "${what}: ${compiler} warns:\n${said}")
  endif()
  run("ctest of ${what}" ${CMAKE_CTEST_COMMAND} --test-dir ${build} --output-on-failure --no-tests=error)
  string(APPEND log "${said}")
  set(log "${log}" PARENT_SCOPE)
endfunction()

# The same for a plugin; then installs it and lists what it holds.
function(use what folder build compiler id)
  build_and_test("${what}" ${folder} ${build} ${compiler})
  run("installing ${what}" ${CMAKE_COMMAND} --install ${build})   # to the Kerf that was found
  run("kerf list with ${what}" ${program} list)
  if(NOT said MATCHES "${id}[/.]")
    message(FATAL_ERROR "`kerf list` does not name ${id}:\n${said}")
  endif()
  message(STATUS "${what}, by ${compiler}:\n${log}\n`kerf list` prints\n${said}")
endfunction()

file(GLOB plugins LIST_DIRECTORIES true RELATIVE ${SOURCE}/plugins ${SOURCE}/plugins/*)
foreach(name IN LISTS plugins)
  if(name STREQUAL "remesh_cgal")
    continue()   # the unit with CGAL compiles for a minute
  endif()
  if(EXISTS ${SOURCE}/plugins/${name}/CMakeLists.txt)
    file(COPY ${SOURCE}/plugins/${name} DESTINATION ${WORK}/alone)
    use("plugins/${name}" ${WORK}/alone/${name} ${WORK}/alone/${name}/build ${other} kerf.${name})
  endif()
endforeach()

# The examples as they are installed, by each compiler.
set(examples ${WORK}/kerf/share/kerf/examples)
foreach(compiler IN LISTS found_compilers)
  get_filename_component(by ${compiler} NAME)
  foreach(pair "01_awl awl" "02_round_burr round_burr" "03_operation operation" "05_trephine trephine" "06_groove ball_groove")
    separate_arguments(pair)
    list(GET pair 0 folder)
    list(GET pair 1 id)
    use("examples/${folder}" ${examples}/${folder} ${WORK}/examples/${folder}-${by} ${compiler} example.${id})
  endforeach()
endforeach()
# Programs around Kerf's library.
foreach(compiler IN LISTS found_compilers)
  get_filename_component(by ${compiler} NAME)
  build_and_test("examples/04_embed" ${examples}/04_embed ${WORK}/examples/04_embed-${by} ${compiler})
  message(STATUS "examples/04_embed, by ${compiler}:\n${log}")
endforeach()
build_and_test("examples/09_viewer" ${examples}/09_viewer ${WORK}/examples/09_viewer ${other})
message(STATUS "examples/09_viewer:\n${log}")

run("kerf validate of an installed example" ${CMAKE_COMMAND} -E chdir ${WORK}/elsewhere ${program} validate biopsy.yaml)

# The beginning of a plugin, as `kerf new plugin` writes it.
run("kerf new plugin" ${CMAKE_COMMAND} -E chdir ${WORK}/elsewhere ${program} new plugin hand_mill)
use("a new plugin" ${WORK}/elsewhere/hand_mill ${WORK}/elsewhere/hand_mill/build ${other} example.hand_mill)
run("kerf new plugin --strategy" ${CMAKE_COMMAND} -E chdir ${WORK}/elsewhere ${program} new plugin hand_groove --strategy)
use("a new strategy" ${WORK}/elsewhere/hand_groove ${WORK}/elsewhere/hand_groove/build ${other} example.hand_groove)
foreach(name hand_mill hand_groove)
  file(READ ${WORK}/elsewhere/${name}/README.md readme)
  if(readme MATCHES "round_burr|ball_groove|0[26]_|Next:")
    message(FATAL_ERROR "the README of a new plugin still speaks of the example:\n${readme}")
  endif()
endforeach()
# Its strategy makes the surface of its own procedure.
run("kerf run with a new strategy" ${CMAKE_COMMAND} -E env KERF_PLUGIN_PATH=${WORK}/elsewhere/hand_groove/build/lib/kerf
  ${program} run ${WORK}/elsewhere/hand_groove/hand_groove.yaml --out ${WORK}/elsewhere/groove)
file(READ ${WORK}/elsewhere/groove/summary.json summary)
string(JSON strategy GET "${summary}" exact_surface strategies 0 strategy)
string(JSON handed_over GET "${summary}" exact_surface handed_over)
if(NOT strategy STREQUAL "example.hand_groove.groove" OR NOT handed_over EQUAL 0
    OR NOT EXISTS ${WORK}/elsewhere/groove/bone-exact.stl)
  message(FATAL_ERROR "the surface of a new strategy's own procedure is made by ${strategy}, with ${handed_over} stretches handed over:\n${summary}")
endif()
