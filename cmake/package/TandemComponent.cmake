# SPDX-License-Identifier: Apache-2.0
# What tandem_add_opros_component() and tandem_add_rtm_component() have in common.
# tandem_component_libraries(TARGET [PKG_CONFIG module ...] [PKG_CONFIG_IF_FOUND module ...] [FORWARDS dir]
#                            [LIBRARIES_IF_FOUND name ...] [LIBRARY_DIRS dir ...])
# Modules of pkg-config whose headers and libraries the plugin uses; libraries by name, also in the given folders; headers to be
# found where nothing else has one of that name. With opencv4, the headers of OpenCV 1 and 2 are found, which include those that
# OpenCV 4 has in their place.

# Behind the folders of the system: a header in `dir` must not hide another one.
function(tandem_include_last name dir)
  target_compile_options(${name} PRIVATE "SHELL:-idirafter \"${dir}\"")
endfunction()

function(tandem_component_libraries name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FORWARDS" "PKG_CONFIG;PKG_CONFIG_IF_FOUND;LIBRARIES_IF_FOUND;LIBRARY_DIRS")
  if(arg_FORWARDS)
    tandem_include_last(${name} ${arg_FORWARDS})
  endif()
  set(modules ${arg_PKG_CONFIG} ${arg_PKG_CONFIG_IF_FOUND})
  list(REMOVE_DUPLICATES modules)
  foreach(module ${modules})
    find_package(PkgConfig REQUIRED)
    string(MAKE_C_IDENTIFIER "TANDEM_PKG_${module}" id)
    pkg_check_modules(${id} QUIET IMPORTED_TARGET ${module})
    if(${id}_FOUND)
      target_link_libraries(${name} PRIVATE PkgConfig::${id})
      if(module STREQUAL opencv4)
        tandem_include_last(${name} ${TANDEM_OPENCV1_DIR})
      endif()
    elseif(module IN_LIST arg_PKG_CONFIG)
      message(FATAL_ERROR "pkg-config knows no module ${module}; install the Debian package that has ${module}.pc")
    endif()
  endforeach()
  foreach(library ${arg_LIBRARIES_IF_FOUND})
    string(MAKE_C_IDENTIFIER "TANDEM_LIBRARY_${name}_${library}" id)
    find_library(${id} ${library} HINTS ${arg_LIBRARY_DIRS})
    if(${id})
      target_link_libraries(${name} PRIVATE ${${id}})
    endif()
  endforeach()
  # Only libraries that the plugin uses, of the many that OpenCV has.
  target_link_options(${name} PRIVATE -Wl,--as-needed)
endfunction()
