# SPDX-License-Identifier: Apache-2.0
# tandem_add_rtm_component(NAME [FOLDER dir] [SOURCES a.cpp ...] [IDL F.idl ...] [INCLUDE_DIRS dir ...]
#                          [DEFINITIONS X=1 ...] [LIBRARIES x ...] [PKG_CONFIG module ...] [CXX_STANDARD 14])
# The plugin NAME.so of an RT-Component. All but NAME has a default: the sources and IDL files that lie in the folder
# (the current source folder), as RTCBuilder and rtc-template lay them out. Sources with a main() are programs and
# stay out, also of CANDIDATES, which are taken in place of those in the folder. MORE_IDL: IDL files besides those.

# The IDL files of a component's folder; those that come with OpenRTM-aist are compiled in the library already, and
# omniidl-tmpNUMBER.idl is what older omniidl leaves of another file when it is interrupted.
function(tandem_rtm_folder_idl folder idls)
  file(GLOB found CONFIGURE_DEPENDS ${folder}/*.idl ${folder}/idl/*.idl)
  list(FILTER found EXCLUDE REGEX "/omniidl-tmp[^/]*$")
  set(own "")
  foreach(idl ${found})
    get_filename_component(file ${idl} NAME)
    if(NOT EXISTS ${TANDEM_RTM_IDL_INCLUDE}/rtm/idl/${file})
      list(APPEND own ${idl})
    endif()
  endforeach()
  set(${idls} ${own} PARENT_SCOPE)
endfunction()

# Those of the sources that are neither programs nor what was once made from the IDL files.
function(tandem_rtm_own_sources own_sources idls)
  set(made "")
  foreach(idl ${idls})
    get_filename_component(base ${idl} NAME_WE)
    list(APPEND made ${base}Skel.cpp ${base}Stub.cpp ${base}SK.cc ${base}DynSK.cc ${base}Signatures.cpp)
  endforeach()
  set(own "")
  foreach(source ${ARGN})
    get_filename_component(file ${source} NAME)
    file(STRINGS ${source} main REGEX "^[ \t]*int[ \t]+main[ \t]*[(]")
    if(NOT main AND NOT file IN_LIST made)
      list(APPEND own ${source})
    endif()
  endforeach()
  set(${own_sources} ${own} PARENT_SCOPE)
endfunction()

# The C++ sources in a component's folder.
function(tandem_rtm_folder_sources folder sources)
  set(all "")
  foreach(suffix cpp cc cxx c)
    file(GLOB found CONFIGURE_DEPENDS ${folder}/*.${suffix} ${folder}/src/*.${suffix})
    list(APPEND all ${found})
  endforeach()
  set(${sources} ${all} PARENT_SCOPE)
endfunction()

# The folders of its headers: RTCBuilder's include/NAME among them.
function(tandem_rtm_folder_headers folder include_dirs)
  file(GLOB below CONFIGURE_DEPENDS ${folder}/include/*)
  set(found "")
  foreach(dir ${folder} ${folder}/include ${folder}/src ${folder}/idl ${below})
    if(IS_DIRECTORY ${dir})
      list(APPEND found ${dir})
    endif()
  endforeach()
  set(${include_dirs} ${found} PARENT_SCOPE)
endfunction()

function(tandem_add_rtm_component name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOLDER;CXX_STANDARD;FORWARDS"
    "SOURCES;CANDIDATES;IDL;MORE_IDL;INCLUDE_DIRS;DEFINITIONS;LIBRARIES;PKG_CONFIG;PKG_CONFIG_IF_FOUND")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tandem_add_rtm_component(${name}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(folder "${arg_FOLDER}" ABSOLUTE)
  tandem_rtm_folder_headers(${folder} include_dirs)
  if(NOT arg_IDL)
    tandem_rtm_folder_idl(${folder} arg_IDL)
  endif()
  list(APPEND arg_IDL ${arg_MORE_IDL})
  if(NOT arg_SOURCES)
    if(NOT arg_CANDIDATES)
      tandem_rtm_folder_sources(${folder} arg_CANDIDATES)
    endif()
    tandem_rtm_own_sources(arg_SOURCES "${arg_IDL}" ${arg_CANDIDATES})
  endif()
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "tandem_add_rtm_component(${name}): no C++ source in ${folder} nor in ${folder}/src")
  endif()
  if(NOT arg_CXX_STANDARD)
    set(arg_CXX_STANDARD 14) # the last with exception specifications, which older ones use
  endif()

  add_library(${name} MODULE ${arg_SOURCES})
  set(idl_dirs "")
  foreach(idl ${arg_MORE_IDL}) # which may include others beside them
    get_filename_component(dir ${idl} DIRECTORY)
    list(APPEND idl_dirs ${dir})
  endforeach()
  list(REMOVE_DUPLICATES idl_dirs)
  tandem_add_rtm_idl(${name} ${arg_IDL} INCLUDE_DIRS ${folder}/idl ${folder} ${idl_dirs} ${arg_INCLUDE_DIRS})
  target_include_directories(${name} PRIVATE ${include_dirs} ${arg_INCLUDE_DIRS} ${TANDEM_RTM_IDL_INCLUDE}/rtm/ext)
  # Camera and manipulator interfaces only for those that have none of their own.
  target_link_directories(${name} PRIVATE $<TARGET_FILE_DIR:Tandem::rtm>)
  target_link_libraries(${name} PRIVATE Tandem::rtm ${arg_LIBRARIES} ${CMAKE_DL_LIBS} ${TANDEM_RTM_EXT_LIBRARIES})
  tandem_component_libraries(${name} FORWARDS "${arg_FORWARDS}"
    PKG_CONFIG ${arg_PKG_CONFIG} PKG_CONFIG_IF_FOUND ${arg_PKG_CONFIG_IF_FOUND})
  target_compile_definitions(${name} PRIVATE ${arg_DEFINITIONS})
  # Without symbols that are unique in the process the library can be unloaded and built anew; what is missing is told
  # when it is linked and not when it is loaded.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  target_link_options(${name} PRIVATE -Wl,--no-undefined)
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so
    CXX_STANDARD ${arg_CXX_STANDARD} CXX_STANDARD_REQUIRED ON POSITION_INDEPENDENT_CODE ON)
  if(NOT CMAKE_LIBRARY_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
endfunction()
