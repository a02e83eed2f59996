# SPDX-License-Identifier: Apache-2.0
# Third parties, each used as dep::name. Package names and traps: docs/dependencies.md.
function(dep_wrap name)   # the first target that exists wins
  foreach(target IN LISTS ARGN)
    if(TARGET ${target})
      add_library(dep_${name} INTERFACE)
      target_link_libraries(dep_${name} INTERFACE ${target})
      add_library(dep::${name} ALIAS dep_${name})
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "dependency '${name}' not found (tried: ${ARGN})")
endfunction()

if(EXISTS ${CMAKE_SOURCE_DIR}/text)   # core and its tests alone need none of them
  find_package(PkgConfig REQUIRED)
  find_package(yaml-cpp 0.7 CONFIG REQUIRED)
  find_package(nlohmann_json 3.11 CONFIG REQUIRED)
  find_package(CLI11 2.1 CONFIG REQUIRED)
  find_package(SQLite3 REQUIRED)
  find_package(ZLIB REQUIRED)
  # Here, not where it is used: its targets must be seen by whoever links in the end.
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)   # its package lists all that Debian keeps in other ones
  find_package(GDCM 3 REQUIRED)          # codecs of compressed DICOM, nothing else
  unset(CMAKE_MESSAGE_LOG_LEVEL)

  dep_wrap(yaml yaml-cpp::yaml-cpp yaml-cpp)
  dep_wrap(json nlohmann_json::nlohmann_json)
  dep_wrap(cli11 CLI11::CLI11)
  dep_wrap(sqlite SQLite::SQLite3)
  dep_wrap(zlib ZLIB::ZLIB)
  add_library(dep_gdcm INTERFACE)
  target_link_libraries(dep_gdcm INTERFACE gdcmMSFF gdcmDSED gdcmDICT gdcmCommon)
  target_include_directories(dep_gdcm SYSTEM INTERFACE ${GDCM_INCLUDE_DIRS})
  add_library(dep::gdcm ALIAS dep_gdcm)

  # The backend over hidraw: the one over libusb takes devices from the kernel, keyboards too.
  pkg_check_modules(HIDAPI QUIET IMPORTED_TARGET hidapi-hidraw)
  if(HIDAPI_FOUND)
    dep_wrap(hidapi PkgConfig::HIDAPI)
  else()
    message(STATUS "hidapi is missing: the drivers `spacemouse` and `pedal` only report that. Install libhidapi-dev.")
  endif()
endif()
if(KERF_TESTS)
  find_package(GTest CONFIG REQUIRED)
  dep_wrap(gtest GTest::gtest_main)
  if(TARGET dep::hidapi)
    pkg_check_modules(UMOCKDEV QUIET IMPORTED_TARGET umockdev-1.0)
    if(UMOCKDEV_FOUND)
      dep_wrap(umockdev PkgConfig::UMOCKDEV)
    endif()
  endif()
endif()
