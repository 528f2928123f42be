# SPDX-License-Identifier: Apache-2.0
# tandem_add_rtm_idl(TARGET F.idl ... [INCLUDE_DIRS dir ...])
# Compiles service and data IDL files of a component into TARGET. omniidl writes F.hh, FSK.cc, FDynSK.cc and
# FSignatures.cpp, which registers the operations' signatures at run time (RTC::InterfaceSignatures). FSkel.cpp includes
# the three sources, so that each IDL file is one translation unit; FSkel.h and FStub.h are what component sources
# include. FStub.cpp is for targets that only call, and is written but not compiled.
# Several components that use one IDL file share the code through an object library:
#   add_library(my_idl OBJECT)   tandem_add_rtm_idl(my_idl F.idl)   target_link_libraries(MyComponent PRIVATE my_idl)
set(TANDEM_RTM_IDL_TOOLS ${CMAKE_CURRENT_LIST_DIR}/../idl CACHE INTERNAL "")
find_program(OMNIIDL omniidl REQUIRED)

# Runs omniidl for the file `idl` into `directory`; the variable named by `out` gets the generated files: the header and the
# source. BACKEND_FLAGS go to omniidl's C++ back end. INLINE files are included ones whose code is to be generated with it.
function(tandem_run_omniidl out idl directory)
  cmake_parse_arguments(arg "" "" "INCLUDE_DIRS;BACKEND_FLAGS;INLINE" ${ARGN})
  set(inline "")
  if(arg_INLINE)
    set(inline -Wbinline)
  endif()
  get_filename_component(base ${idl} NAME_WE)
  get_filename_component(idl ${idl} ABSOLUTE)
  foreach(name ${idl} ${arg_INCLUDE_DIRS} ${TANDEM_RTM_IDL_TOOLS})
    if(name MATCHES "[\"`$\\]") # omniidl puts the name between double quotes in a command of a shell
      message(FATAL_ERROR "${name} has a '${CMAKE_MATCH_0}' in its name, which omniidl does not read as part of a name; "
        "rename the file or folder")
    endif()
  endforeach()
  set(includes "")
  foreach(dir ${arg_INCLUDE_DIRS})
    list(APPEND includes -I${dir})
  endforeach()
  file(MAKE_DIRECTORY ${directory})
  set(kinds Skel Stub)
  set(includes_skeleton "")
  foreach(kind ${kinds})
    file(CONFIGURE OUTPUT ${directory}/${base}${kind}.h @ONLY CONTENT
"// Made from ${base}.idl; changes are lost.\n#pragma once\n#include \"${base}.hh\"\n")
    file(CONFIGURE OUTPUT ${directory}/${base}${kind}.cpp @ONLY CONTENT
"// Made from ${base}.idl; changes are lost.\n#include \"${base}${kind}.h\"\n#include \"${base}SK.cc\"\n#include \"${base}DynSK.cc\"\n#include \"${base}Signatures.cpp\"\n")
  endforeach()
  add_custom_command(
    OUTPUT ${directory}/${base}.hh ${directory}/${base}SK.cc ${directory}/${base}DynSK.cc
           ${directory}/${base}Signatures.cpp
    COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1
            ${OMNIIDL} -nf -p${TANDEM_RTM_IDL_TOOLS} -bcxx -Wba -Wbuse_quotes -Wbh=.hh -Wbs=SK.cc -Wbd=DynSK.cc
            ${arg_BACKEND_FLAGS} ${inline} -btandem_signatures ${inline} -C${directory} ${includes} ${idl}
    DEPENDS ${idl} ${arg_INLINE} ${TANDEM_RTM_IDL_TOOLS}/tandem_signatures.py
    COMMENT "omniidl ${base}.idl" VERBATIM)
  set_source_files_properties(${directory}/${base}Skel.cpp PROPERTIES
    COMPILE_OPTIONS -w SKIP_LINTING ON
    OBJECT_DEPENDS "${directory}/${base}SK.cc;${directory}/${base}DynSK.cc;${directory}/${base}Signatures.cpp")
  if(TARGET rtm_idl_headers) # for what reads sources without compiling the generated ones
    string(MD5 id ${directory})
    add_custom_target(rtm_idl_header_${base}_${id} DEPENDS ${directory}/${base}.hh)
    add_dependencies(rtm_idl_headers rtm_idl_header_${base}_${id})
  endif()
  set(${out} ${directory}/${base}.hh ${directory}/${base}Skel.cpp PARENT_SCOPE)
endfunction()

function(tandem_add_rtm_idl target)
  cmake_parse_arguments(arg "" "" "INCLUDE_DIRS" ${ARGN})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${target}_idl)
  foreach(idl ${arg_UNPARSED_ARGUMENTS})
    tandem_run_omniidl(sources ${idl} ${directory}
      INCLUDE_DIRS ${arg_INCLUDE_DIRS} ${TANDEM_RTM_IDL_TOOLS} ${TANDEM_RTM_IDL_INCLUDE}
      BACKEND_FLAGS -Wbshortcut) # consumers call providers of their process without a dispatcher
    target_sources(${target} PRIVATE ${sources})
  endforeach()
  target_include_directories(${target} SYSTEM PUBLIC ${directory})
endfunction()
