// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::command {

/// The beginning of a line in CMake's output that names a missing package.
inline constexpr char missing_package[] = "-- tandem: no package ";

/// CMake code that runs before project(). It lets a project configure without what only some of its targets or only
/// builds need. CMake keeps a replaced command under its name with a leading underscore.
inline constexpr char tolerant_project[] = R"(get_property(defined GLOBAL PROPERTY TANDEM_TOLERANT)
if(defined)
  return()
endif()
set_property(GLOBAL PROPERTY TANDEM_TOLERANT ON)
cmake_policy(PUSH) # those of the project must not change
cmake_policy(VERSION 3.16)
find_package(PkgConfig QUIET)
macro(tandem_note_missing prefix) # further: the name of the package, or its modules
  string(TOUPPER ${prefix} tandem_upper)
  if("REQUIRED" IN_LIST tandem_arguments AND NOT ${prefix}_FOUND AND NOT ${tandem_upper}_FOUND)
    set(tandem_names ${ARGN})
    list(JOIN tandem_names " " tandem_names)
    message(STATUS "tandem: no package ${tandem_names}")
  endif()
endmacro()
macro(find_package)
  set(tandem_arguments ${ARGV})
  if(NOT ("${ARGV0}" STREQUAL "PkgConfig" AND PkgConfig_FOUND)) # it would replace pkg_check_modules()
    list(TRANSFORM tandem_arguments REPLACE "^REQUIRED$" COMPONENTS) # components may follow REQUIRED
    if("${ARGV0}" MATCHES "^OpenRTM") # projects have their own FindOpenRTM.cmake, for installations of OpenRTM-aist
      list(INSERT tandem_arguments 1 CONFIG)
    endif()
    _find_package(${tandem_arguments})
    set(tandem_arguments ${ARGV})
    tandem_note_missing(${ARGV0} ${ARGV0})
  endif()
endmacro()
macro(pkg_check_modules prefix)
  set(tandem_modules ${ARGN})
  list(REMOVE_ITEM tandem_modules REQUIRED QUIET IMPORTED_TARGET GLOBAL)
  set(tandem_arguments ${ARGV})
  list(REMOVE_ITEM tandem_arguments REQUIRED)
  _pkg_check_modules(${tandem_arguments})
  set(tandem_arguments ${ARGV})
  tandem_note_missing(${prefix} ${tandem_modules})
endmacro()
function(configure_file) # of the project's own package, whose templates may be missing
  get_filename_component(tandem_template "${ARGV0}" ABSOLUTE)
  if(EXISTS "${tandem_template}")
    _configure_file(${ARGV})
  endif()
endfunction()
function(add_dependencies) # on targets of documentation or IDL that do not exist
endfunction()
function(message)
  set(arguments ${ARGV})
  list(TRANSFORM arguments REPLACE "^(FATAL|SEND)_ERROR$" WARNING) # CPack sends one for each missing file
  _message(${arguments} "") # also without text
endfunction()
cmake_policy(POP)
)";

} // namespace tandem::command
