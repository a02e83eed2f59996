# SPDX-License-Identifier: Apache-2.0
# find_package(kerf): kerf::sdk (headers, no dependency), kerf::program (`kerf`), kerf_add_plugin().
include(${CMAKE_CURRENT_LIST_DIR}/kerfTargets.cmake)
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
