# SPDX-License-Identifier: Apache-2.0
# What `cpack` makes of a full build (`./dev package`): a Debian package of each component of KerfInstall.cmake.
#
#   kerf               component program
#   kerf-dev           component sdk
#   kerf-window        component window, apart because a machine without a display needs none of its libraries
#   kerf-remesh-cgal   component remesh_cgal, apart because it is under the GPL
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(kerf_packages program kerf sdk kerf-dev remesh_cgal kerf-remesh-cgal)   # component, package, …
if(KERF_WINDOW)
  list(APPEND kerf_packages window kerf-window)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Kerf developers <maintainers@kerf.invalid>")   # no address is public
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)   # whatever the umask is
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)   # plugins: nothing links them

set(notice "For training and research; not for diagnosis, planning or deciding treatment.")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "haptic simulation of bone surgery
Kerf drills, saws and burrs a virtual bone in ticks of one millisecond. It
removes the bone that the tool cuts, and computes the force on the hand. A
simulated hand carries out procedures, which are YAML files. Drivers connect
haptic devices over UDP, Inverse3, omega and its like, SpaceMouse, foot pedal.

${notice}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "kerf-remesh-cgal, kerf-window")

set(CPACK_DEBIAN_WINDOW_DESCRIPTION "haptic simulation of bone surgery: the window
Shows an operation while it runs, and a recorded one again: bone, tool, forces,
steps, limits and verdict. Needs OpenGL 3.3; a software renderer suffices.

${notice}")
set(CPACK_DEBIAN_WINDOW_PACKAGE_DEPENDS   # libglfw3: the one for X11; ImGui loads OpenGL and EGL by name
  "kerf (= ${PROJECT_VERSION}), libglfw3, libgl1, libegl1, fonts-dejavu-core")
set(CPACK_DEBIAN_WINDOW_PACKAGE_RECOMMENDS libgl1-mesa-dri)

set(CPACK_DEBIAN_SDK_DESCRIPTION "haptic simulation of bone surgery: plugins and embedding
Headers to write a plugin for Kerf, static libraries to run a procedure in
another program, the CMake package, and examples.

${notice}")
set(CPACK_DEBIAN_SDK_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_SDK_PACKAGE_DEPENDS   # find_package(kerf COMPONENTS run) needs the libraries
  "kerf (= ${PROJECT_VERSION}), libyaml-cpp-dev, nlohmann-json3-dev, libsqlite3-dev, zlib1g-dev, libgdcm-dev")
set(CPACK_DEBIAN_SDK_PACKAGE_SUGGESTS "g++, cmake")

set(CPACK_DEBIAN_REMESH_CGAL_DESCRIPTION "haptic simulation of bone surgery: exact surfaces by CGAL
The remeshing strategies `exact` and `local` of Kerf. They cut the mesh of a
bone by what a tool sweeps, in exact arithmetic. This package is licensed under
GPL-3.0-or-later, because the parts of CGAL that it uses are.

${notice}")
set(CPACK_DEBIAN_REMESH_CGAL_PACKAGE_DEPENDS "kerf (= ${PROJECT_VERSION})")

set(CPACK_COMPONENTS_ALL)
while(kerf_packages)
  list(POP_FRONT kerf_packages component package)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/package/${package}/copyright DESTINATION share/doc/${package} COMPONENT ${component})
endwhile()
include(CPack)
