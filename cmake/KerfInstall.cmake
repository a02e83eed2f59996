# SPDX-License-Identifier: Apache-2.0
# What is installed, below one prefix that may be moved as a whole: everything finds the rest from where it is itself.
#
#   component program, which an install rule in this tree gets if it names none
#     bin/kerf                 the program, core's runtime in it
#     libexec/kerf             the programs that it starts
#     lib/kerf/*.so            plugins, each by its own kerf_add_plugin()
#     share/kerf/procedures    procedures and their anatomies
#     share/kerf/system        rules and limits for an administrator to install, by app/CMakeLists.txt
#     lib/udev/rules.d         the rules again, where udev reads them if the prefix is /usr
#     share/doc/kerf           the documentation
#     share/man/man1           the manual page; app/CMakeLists.txt makes it and the next three
#     share/bash-completion/completions, share/zsh/site-functions, share/fish/vendor_completions.d
#   component sdk
#     include/kerf             the headers of core/sdk: target kerf::sdk, which needs nothing
#     include/kerf-run         the headers of core, the rooms on it, run and devices
#     lib/kerf-run/*.a         these as libraries, by run/CMakeLists.txt: target kerf::run
#     lib/cmake/kerf           find_package(kerf): kerf::sdk, kerf::program, kerf_add_plugin(); COMPONENTS run: kerf::run
#     share/kerf/examples      plugins and a program to begin with, each a project of its own
#   component window
#     libexec/kerf/kerf-window
#   component remesh_cgal, under the GPL
#     lib/kerf/kerf_remesh_cgal.so
#
# `./dev run` builds less than all. A rule for what it leaves out is OPTIONAL, so that `cmake --install` works after it
# (tests/house/install.sh).
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(kerf_package lib/cmake/kerf)

install(EXPORT kerfTargets NAMESPACE kerf:: DESTINATION ${kerf_package} COMPONENT sdk)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/kerfConfigVersion.cmake COMPATIBILITY SameMinorVersion)   # ABI 0 promises no more
install(FILES
  ${CMAKE_CURRENT_LIST_DIR}/kerfConfig.cmake
  ${CMAKE_CURRENT_LIST_DIR}/KerfPlugin.cmake
  ${CMAKE_CURRENT_LIST_DIR}/KerfPluginTest.cmake
  ${CMAKE_CURRENT_LIST_DIR}/kerf_plugin.map
  ${CMAKE_BINARY_DIR}/kerfConfigVersion.cmake
  DESTINATION ${kerf_package} COMPONENT sdk)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/procedures/ DESTINATION share/kerf/procedures FILES_MATCHING PATTERN "*.yaml")
foreach(file LICENSE README.md CHANGELOG.md CITATION.cff SECURITY.md)
  install(FILES ${CMAKE_SOURCE_DIR}/${file} DESTINATION share/doc/kerf)
endforeach()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION share/doc/kerf/docs)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/ DESTINATION share/kerf/examples COMPONENT sdk PATTERN build EXCLUDE)
