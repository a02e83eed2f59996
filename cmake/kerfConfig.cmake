# SPDX-License-Identifier: Apache-2.0
# find_package(kerf): kerf::sdk (headers, no dependency), kerf::program (`kerf`), kerf_add_plugin().
# find_package(kerf COMPONENTS run): also kerf::run, a whole run as a library. It needs the libraries that Kerf needs.
include(${CMAKE_CURRENT_LIST_DIR}/kerfTargets.cmake)
if("run" IN_LIST kerf_FIND_COMPONENTS)
  include(CMakeFindDependencyMacro)
  find_dependency(yaml-cpp 0.7 CONFIG)
  find_dependency(nlohmann_json 3.11 CONFIG)
  find_dependency(SQLite3)
  find_dependency(ZLIB)
  set(kerf_log_level ${CMAKE_MESSAGE_LOG_LEVEL})
  set(CMAKE_MESSAGE_LOG_LEVEL ERROR)   # the package of GDCM lists all that Debian keeps in other ones
  find_dependency(GDCM 3)
  set(CMAKE_MESSAGE_LOG_LEVEL ${kerf_log_level})
  unset(kerf_log_level)
  include(${CMAKE_CURRENT_LIST_DIR}/kerfRunTargets.cmake)
  set(kerf_run_FOUND TRUE)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/KerfPlugin.cmake)

# A law that is not optimised does not keep its tick.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

# Where this Kerf is, a plugin of it is found.
if(CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
  get_filename_component(kerf_prefix ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
  set(CMAKE_INSTALL_PREFIX ${kerf_prefix} CACHE PATH "Where `cmake --install` puts the plugin: to the Kerf that was found" FORCE)
  unset(kerf_prefix)
endif()
