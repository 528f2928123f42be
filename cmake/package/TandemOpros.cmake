# SPDX-License-Identifier: Apache-2.0
# tandem_add_opros_component(NAME [FOLDER dir] [SOURCES a.cpp ...] [INCLUDE_DIRS dir ...] [PROFILES X.xml ...]
#                            [DEFINITIONS X=1 ...] [LIBRARIES x ...] [PKG_CONFIG module ...] [CXX_STANDARD 14])
# Builds the plugin NAME.so of an OPRoS component and copies its profiles beside it. By default, takes the sources and profiles
# in the folder (the current source folder), as OPRoS components are laid out. Sources with a main() are programs and are left
# out, also of CANDIDATES, which replace the sources in the folder.

# Sources, include folders and profiles of a component's folder.
function(tandem_opros_folder folder sources include_dirs profiles)
  set(found_sources "")
  foreach(place . src)
    foreach(suffix cpp cc cxx c)
      file(GLOB files CONFIGURE_DEPENDS ${folder}/${place}/*.${suffix})
      list(APPEND found_sources ${files})
    endforeach()
  endforeach()
  set(found_dirs "")
  foreach(place . include src)
    get_filename_component(dir ${folder}/${place} ABSOLUTE)
    if(IS_DIRECTORY ${dir})
      list(APPEND found_dirs ${dir})
    endif()
  endforeach()
  set(found_profiles "")
  foreach(place . profile profiles)
    file(GLOB files CONFIGURE_DEPENDS ${folder}/${place}/*.[xX][mM][lL])
    list(APPEND found_profiles ${files})
  endforeach()
  set(${sources} ${found_sources} PARENT_SCOPE)
  set(${include_dirs} ${found_dirs} PARENT_SCOPE)
  set(${profiles} ${found_profiles} PARENT_SCOPE)
endfunction()

function(tandem_add_opros_component name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOLDER;CXX_STANDARD;FORWARDS"
    "SOURCES;CANDIDATES;INCLUDE_DIRS;PROFILES;DEFINITIONS;LIBRARIES;PKG_CONFIG;PKG_CONFIG_IF_FOUND;LIBRARIES_IF_FOUND;LIBRARY_DIRS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tandem_add_opros_component(${name}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(folder "${arg_FOLDER}" ABSOLUTE)
  tandem_opros_folder(${folder} sources include_dirs profiles)
  if(arg_CANDIDATES)
    set(sources ${arg_CANDIDATES})
  endif()
  tandem_remove_programs(sources)
  if(arg_SOURCES)
    set(sources ${arg_SOURCES})
  endif()
  if(arg_PROFILES)
    set(profiles ${arg_PROFILES})
  endif()
  if(NOT sources)
    message(FATAL_ERROR "tandem_add_opros_component(${name}): no C++ source in ${folder} nor in ${folder}/src")
  endif()
  if(NOT arg_CXX_STANDARD)
    set(arg_CXX_STANDARD 14) # what most of them are written in
  endif()

  add_library(${name} MODULE ${sources})
  # Interface folders of the platform come last, so that a component's own header of the same name wins.
  get_target_property(api Tandem::opros INTERFACE_INCLUDE_DIRECTORIES)
  list(TRANSFORM api APPEND /device OUTPUT_VARIABLE device_api)
  target_include_directories(${name} PRIVATE ${include_dirs} ${arg_INCLUDE_DIRS} ${api} ${device_api})
  target_link_libraries(${name} PRIVATE Tandem::opros ${arg_LIBRARIES} ${CMAKE_DL_LIBS})
  tandem_component_libraries(${name} FORWARDS "${arg_FORWARDS}"
    PKG_CONFIG ${arg_PKG_CONFIG} PKG_CONFIG_IF_FOUND ${arg_PKG_CONFIG_IF_FOUND}
    LIBRARIES_IF_FOUND ${arg_LIBRARIES_IF_FOUND} LIBRARY_DIRS ${arg_LIBRARY_DIRS})
  # What the components' own makefiles define; without it some sources take their Windows branch.
  target_compile_definitions(${name} PRIVATE _OPROS_LINUX_ ${arg_DEFINITIONS})
  # Without symbols that are unique in the process, the library can be unloaded and rebuilt. Missing symbols are reported
  # when it is linked, not when it is loaded.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  target_link_options(${name} PRIVATE -Wl,--no-undefined)
  # A function without its return statement returns to its caller, as with the compilers for which components were
  # written. Today's optimizer would let it run into the code that follows it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT "${CMAKE_CXX_FLAGS}" MATCHES "-fsanitize")
    target_compile_options(${name} PRIVATE -fsanitize=unreachable -fsanitize-undefined-trap-on-error)
  elseif(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    target_compile_options(${name} PRIVATE -fno-strict-return)
  endif()
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so
    CXX_STANDARD ${arg_CXX_STANDARD} CXX_STANDARD_REQUIRED ON POSITION_INDEPENDENT_CODE ON)
  if(NOT CMAKE_LIBRARY_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  get_target_property(beside ${name} LIBRARY_OUTPUT_DIRECTORY)
  foreach(profile ${profiles})
    get_filename_component(file ${profile} NAME)
    configure_file(${profile} ${beside}/${file} COPYONLY)
  endforeach()
endfunction()
