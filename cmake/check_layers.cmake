# SPDX-License-Identifier: Apache-2.0
# cmake -D ROOT=<source tree> -P check_layers.cmake
#
# Who may know whom (docs/overview.md):
#   core/…          kerf/…, its own layer or an earlier one, std and the C library; core/sdk only kerf/… and std
#   text, documents, session, bone/…   the same, and third parties
#   plugins/<name>  kerf/…, its own folder, std; CGAL in plugins/remesh_cgal/booleans.cpp, OpenMesh in plugins/burring/displace
#   devices/<name>  the same, the C library, devices/{library,motion,realtime}, and devices/hid, which alone includes hidapi
#   studies/papers/<name>  kerf/…, its own folder, plugins/…, std: plugins that only charts and tests find
#   run/…           kerf/…, the layers, devices/…, run/…, third parties; plugins it finds at run time
#   conformance/…   kerf/…, the layers, conformance/…, studies/drawing/…, third parties; plugins it is given at run time
#   studies/…       kerf/…, the layers, devices/…, studies/…, third parties; plugins, also papers/<name>, it finds at run time
# and no layer names a plugin: neither its id, nor its module, nor its folder. Nor do layers, run and app name a remeshing
# strategy of a plugin. Comments may, as examples.
cmake_minimum_required(VERSION 3.25)

# Each may include itself and those before it.
set(layers
  core/sdk core/field core/field/grid core/field/cut core/field/surface core/field/pieces core/plugin
  core/haptics core/haptics/law core/haptics/loop core/haptics/scene core/haptics/watch
  text documents session
  bone/report bone/image bone/surface bone/import bone/measure bone/radiograph bone/remesh bone/exact)
set(nested core/field/grid/kernel documents/made documents/made/femur documents/made/mandible documents/made/vertebra documents/shapes documents/yaml session/report)   # parts of the layer above them, without an order
set(rooms core text documents session bone)
set(c_library dlfcn.h elf.h emmintrin.h fcntl.h immintrin.h poll.h pthread.h sched.h semaphore.h unistd.h x86intrin.h)
set(std_c_headers assert.h ctype.h errno.h fenv.h float.h inttypes.h limits.h locale.h math.h setjmp.h signal.h
    stdalign.h stdarg.h stdatomic.h stdbool.h stddef.h stdint.h stdio.h stdlib.h string.h tgmath.h time.h uchar.h
    wchar.h wctype.h)
set(violations 0)

# Reports one line of `content`, given the text that is wrong in it.
function(report file content text what allowed)
  string(FIND "${content}" "${text}" at)
  string(SUBSTRING "${content}" 0 ${at} before)
  string(REGEX MATCHALL "\n" newlines "${before}\n")
  list(LENGTH newlines line)
  file(RELATIVE_PATH name "${ROOT}" "${file}")
  message(NOTICE "${name}:${line}: ${what}. Allowed: ${allowed}.")
  math(EXPR count "${violations} + 1")
  set(violations ${count} PARENT_SCOPE)
endfunction()

function(read file out)
  file(READ "${file}" content)
  string(REGEX REPLACE "[][;\\]" " " content "${content}")   # they have a meaning in CMake's lists, none here
  string(REPLACE "\r" "" content "${content}")
  set(${out} "\n${content}" PARENT_SCOPE)                    # so that each line starts after a newline
endfunction()

# `includes`: the directives as they stand, each with the newline before it. Inside block comments they count too.
function(find_includes content out)
  string(REGEX MATCHALL "\n[ \t]*#[ \t]*include[ \t]*[<\"][^>\"\n]+[>\"]" includes "${content}")
  set(${out} "${includes}" PARENT_SCOPE)
endfunction()

function(split_include directive out_path out_is_angled)
  string(REGEX MATCH "([<\"])([^>\"\n]+)[>\"]$" ignored "${directive}")
  set(${out_path} "${CMAKE_MATCH_2}" PARENT_SCOPE)
  if(CMAKE_MATCH_1 STREQUAL "<")
    set(${out_is_angled} TRUE PARENT_SCOPE)
  else()
    set(${out_is_angled} FALSE PARENT_SCOPE)
  endif()
endfunction()

function(is_std path out)
  if(path MATCHES "^[a-z_0-9]+$" OR path IN_LIST std_c_headers)
    set(${out} TRUE PARENT_SCOPE)
  else()
    set(${out} FALSE PARENT_SCOPE)
  endif()
endfunction()

function(folders_in parent out)
  file(GLOB entries LIST_DIRECTORIES true RELATIVE "${ROOT}/${parent}" "${ROOT}/${parent}/*")
  set(folders)
  foreach(entry IN LISTS entries)
    if(IS_DIRECTORY "${ROOT}/${parent}/${entry}")
      list(APPEND folders ${entry})
    endif()
  endforeach()
  set(${out} "${folders}" PARENT_SCOPE)
endfunction()

# The layer that a path lies in: the longest of their names that begins it.
function(layer_of path out)
  set(found "")
  foreach(layer IN LISTS layers)
    string(LENGTH "${layer}" length)
    string(LENGTH "${found}" longest)
    string(FIND "${path}" "${layer}/" at)
    if(at EQUAL 0 AND length GREATER longest)
      set(found "${layer}")
    endif()
  endforeach()
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

function(check_layer_include file content directive layer)
  split_include("${directive}" path is_angled)
  is_std("${path}" is_std)
  list(FIND layers ${layer} rank)
  set(allowed "kerf/…, ${layer} and the layers before it in cmake/check_layers.cmake")
  set(what "${layer} must not include \"${path}\"")
  string(REGEX MATCH "^[^/]+" room "${path}")

  if(path MATCHES "^kerf/" OR (is_angled AND is_std))
    return()
  elseif(path MATCHES "(^|/)\\.\\./")
    set(what "${what}: a path through \"..\" hides which layer it reaches")
    set(allowed "${allowed}, written from the root of the tree")
  elseif(room IN_LIST rooms)
    layer_of("${path}" other)
    list(FIND layers "${other}" other_rank)
    if(NOT other STREQUAL "" AND other_rank LESS_EQUAL rank)
      return()
    elseif(NOT other STREQUAL "")
      set(what "${what}: ${other} is a later layer")
    else()
      set(what "${what}: it lies in no layer")
    endif()
  elseif(path MATCHES "^(plugins|devices|run|app|tests|bench|examples|conformance|studies)/")
    set(what "${what}: ${layer} knows nothing of what uses it")
  elseif(layer STREQUAL "core/sdk")
    set(what "${what}: the sdk needs nothing but a compiler")
    set(allowed "kerf/… and the standard library")
  elseif(layer MATCHES "^core/" AND is_angled AND NOT (path IN_LIST c_library OR path MATCHES "^(sys|linux)/"))
    set(what "${what}: core needs no third-party library")
    set(allowed "kerf/…, core, the standard library and the C library")
  else()
    return()   # a third party, or a file beside this one
  endif()
  report("${file}" "${content}" "${directive}" "${what}" "${allowed}")
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# What would tie a layer to one plugin or device, outside comments.
function(check_names file content pattern comment)
  string(REGEX MATCHALL "\n[^\n]*(${pattern})[^\n]*" lines "${content}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "${comment}" "" code "${line}")
    if(code MATCHES "^\n[ \t]*#[ \t]*include" OR NOT "${code} " MATCHES "(${pattern})[^A-Za-z0-9_]")
      continue()
    endif()
    report("${file}" "${content}" "${line}" "a layer must not name \"${CMAKE_MATCH_1}\""
      "nothing of a plugin or device; core finds them at run time, and procedures name them")
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()

function(check_plugin_include file content directive folder)
  split_include("${directive}" path is_angled)
  is_std("${path}" is_std)
  get_filename_component(beside "${file}" DIRECTORY)
  if(is_angled AND path MATCHES "^CGAL/" AND file STREQUAL "${ROOT}/plugins/remesh_cgal/booleans.cpp")
    return()
  elseif(is_angled AND path MATCHES "^OpenMesh/" AND file MATCHES "/plugins/burring/displace/[^/]+$")
    return()
  elseif(folder MATCHES "^devices/" AND is_angled AND (path IN_LIST c_library OR path MATCHES "^(arpa|linux|netinet|sys)/"))
    return()
  elseif(folder MATCHES "^devices/" AND path MATCHES "^devices/(hid|library|motion|realtime)/[a-z_]+\\.h$")
    return()
  elseif(is_angled AND path STREQUAL "nlohmann/json.hpp" AND file STREQUAL "${ROOT}/devices/haply/service_text.cpp")
    return()
  elseif(is_angled AND path STREQUAL "libwebsockets.h" AND file STREQUAL "${ROOT}/devices/haply/web_sockets.cpp")
    return()
  elseif(is_angled AND path STREQUAL "hidapi.h" AND file STREQUAL "${ROOT}/devices/hid/hidapi_transport.cpp")
    return()
  elseif(path MATCHES "(^|/)\\.\\./")
    # may leave the folder: refused below
  elseif(path MATCHES "^kerf/" OR (is_angled AND is_std))
    return()
  elseif(NOT is_angled)
    string(FIND "${path}" "${folder}/" at)
    if(at EQUAL 0 OR EXISTS "${beside}/${path}" OR (folder MATCHES "^studies/papers/" AND path MATCHES "^plugins/"))
      return()
    endif()
  endif()
  report("${file}" "${content}" "${directive}" "${folder} must not include \"${path}\""
    "kerf/…, \"${folder}/…\" and the standard library")
  set(violations ${violations} PARENT_SCOPE)
endfunction()

# `folder` may include the layers, devices and itself.
function(check_library_include file content directive folder others)
  split_include("${directive}" path is_angled)
  if(path MATCHES "(^|/)\\.\\./" OR path MATCHES "^(${others})/")
    report("${file}" "${content}" "${directive}" "${folder} must not include \"${path}\""
      "kerf/…, the layers, devices/… and ${folder}/…, written from the root of the tree")
    set(violations ${violations} PARENT_SCOPE)
  endif()
endfunction()

# ---- layers ------------------------------------------------------------------------------------------------------

folders_in(plugins plugins)
folders_in(devices devices)
set(names)
foreach(name IN LISTS plugins)
  list(APPEND names "kerf\\.${name}" "kerf_${name}" "kerf::${name}" "plugins/${name}")
endforeach()
foreach(name IN LISTS devices)
  list(APPEND names "kerf\\.${name}" "kerf_${name}" "kerf::${name}" "devices/${name}")
endforeach()
list(JOIN names "|" names)

set(sources)
foreach(room IN LISTS rooms)
  file(GLOB_RECURSE of_room "${ROOT}/${room}/*.h" "${ROOT}/${room}/*.hpp" "${ROOT}/${room}/*.cpp")
  list(APPEND sources ${of_room})
endforeach()
foreach(file IN LISTS sources)
  file(RELATIVE_PATH path "${ROOT}" "${file}")
  get_filename_component(folder "${path}" DIRECTORY)
  layer_of("${path}" layer)
  if(NOT (folder STREQUAL layer OR folder IN_LIST nested OR folder STREQUAL "core/sdk/include/kerf"))
    list(JOIN layers ", " known)
    message(NOTICE "${folder}: this folder is no layer. Allowed: ${known} (in this order; cmake/check_layers.cmake).")
    math(EXPR violations "${violations} + 1")
    continue()
  endif()
  read("${file}" content)
  find_includes("${content}" includes)
  foreach(directive IN LISTS includes)
    check_layer_include("${file}" "${content}" "${directive}" ${layer})
  endforeach()
  if(names)
    check_names("${file}" "${content}" "${names}" "(//|/\\*|\n[ \t]*\\*).*")
  endif()
endforeach()
if(names)
  foreach(room IN LISTS rooms)
    file(GLOB_RECURSE lists "${ROOT}/${room}/CMakeLists.txt")
    foreach(file IN LISTS lists)
      read("${file}" content)
      check_names("${file}" "${content}" "${names}" "#.*")
    endforeach()
  endforeach()
endif()

# ---- strategies of plugins -------------------------------------------------------------------------------------

# Their ids: the first text of a describe() that states what a strategy gets.
set(strategies)
file(GLOB_RECURSE sources "${ROOT}/plugins/*.h")
foreach(file IN LISTS sources)
  read("${file}" content)
  string(REGEX MATCHALL "describe\\([^()]*remeshes_" descriptions "${content}")
  foreach(description IN LISTS descriptions)
    if(description MATCHES "describe\\([ \n]*\"([a-z_0-9]+)\"")
      list(APPEND strategies ${CMAKE_MATCH_1})
    endif()
  endforeach()
endforeach()
if(EXISTS "${ROOT}/plugins/remesh_cgal" AND NOT strategies)
  message(FATAL_ERROR "layers: found no strategy in plugins. Correct how cmake/check_layers.cmake finds them.")
endif()
list(JOIN strategies "|" strategies)
foreach(folder core/plugin text documents session bone/remesh bone/exact run app)   # bone/image reads words of other formats
  file(GLOB_RECURSE sources "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
  foreach(file IN LISTS sources)
    read("${file}" content)
    string(REGEX MATCHALL "\n[^\n]*[\"`.](${strategies})[\"`][^\n]*" lines "${content}")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "//.*" "" code "${line}")
      if(strategies AND code MATCHES "[\"`.](${strategies})[\"`]")
        report("${file}" "${content}" "${line}" "${folder} must not name the strategy \"${CMAKE_MATCH_1}\""
          "none of a plugin's; tools name those that suit them, and procedures name any")
      endif()
    endforeach()
  endforeach()
endforeach()

# ---- plugins and devices -----------------------------------------------------------------------------------------

folders_in(studies/papers studies/papers)
foreach(kind plugins devices studies/papers)
  foreach(name IN LISTS ${kind})
    file(GLOB_RECURSE sources "${ROOT}/${kind}/${name}/*.h" "${ROOT}/${kind}/${name}/*.hpp" "${ROOT}/${kind}/${name}/*.cpp")
    foreach(file IN LISTS sources)
      read("${file}" content)
      find_includes("${content}" includes)
      foreach(directive IN LISTS includes)
        check_plugin_include("${file}" "${content}" "${directive}" ${kind}/${name})
      endforeach()
    endforeach()
  endforeach()
endforeach()

# ---- run and studies ---------------------------------------------------------------------------------------------

function(check_library folder others)
  file(GLOB_RECURSE sources "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.hpp" "${ROOT}/${folder}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/studies/papers/[^/]+/")   # plugins, checked above
  foreach(file IN LISTS sources)
    read("${file}" content)
    find_includes("${content}" includes)
    foreach(directive IN LISTS includes)
      check_library_include("${file}" "${content}" "${directive}" ${folder} "${others}")
    endforeach()
  endforeach()
  set(violations ${violations} PARENT_SCOPE)
endfunction()
check_library(run "plugins|studies|app|conformance|tests|bench|examples")
check_library(studies "plugins|studies/papers/[a-z_]+|run|app|conformance|tests|bench|examples")
check_library(conformance "plugins|devices|run|app|tests|bench|studies/(chart|papers|plan|scenes|stability)")

# ---- the window --------------------------------------------------------------------------------------------------

# Of Kerf it includes one header, so that another viewer could replace it. No other folder sees its libraries.
file(GLOB_RECURSE sources "${ROOT}/app/window/*.h" "${ROOT}/app/window/*.cpp")
foreach(file IN LISTS sources)
  read("${file}" content)
  find_includes("${content}" includes)
  foreach(directive IN LISTS includes)
    split_include("${directive}" path is_angled)
    if(NOT is_angled AND NOT path MATCHES "^app/window/[a-z_]+\\.h$" AND NOT path STREQUAL "run/view/viewed_run.h")
      report("${file}" "${content}" "${directive}" "app/window must not include \"${path}\""
        "app/window/…, run/view/viewed_run.h and other libraries")
    endif()
  endforeach()
endforeach()
file(GLOB_RECURSE sources "${ROOT}/app/*.h" "${ROOT}/app/*.cpp")
list(FILTER sources EXCLUDE REGEX "/app/window/")
foreach(file IN LISTS sources)
  read("${file}" content)
  find_includes("${content}" includes)
  foreach(directive IN LISTS includes)
    split_include("${directive}" path is_angled)
    if(path MATCHES "^(GLFW|epoxy|glm|backends|EGL)/|^imgui")
      report("${file}" "${content}" "${directive}" "${path} is for app/window alone" "app/window/…")
    endif()
  endforeach()
endforeach()

if(violations GREATER 0)
  message(FATAL_ERROR "layers: ${violations} line(s) know what they must not know")
endif()
