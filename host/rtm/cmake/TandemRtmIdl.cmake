# SPDX-License-Identifier: Apache-2.0
# tandem_add_rtm_idl(TARGET F.idl ... [INCLUDE_DIRS dir ...])
# Compiles service and data IDL files of a component into TARGET: F.hh FSK.cc FDynSK.cc (omniidl),
# the thin FSkel.h FSkel.cpp FStub.h FStub.cpp that component sources include, and FSignatures.cpp, with
# which the operations' signatures are known at run time (RTC::InterfaceSignatures).
# FSkel.cpp is compiled; FStub.cpp, its equal for targets that only call, is written beside it.
set(TANDEM_RTM_IDL_TOOLS ${CMAKE_CURRENT_LIST_DIR}/../idl CACHE INTERNAL "")
find_program(OMNIIDL omniidl REQUIRED)

# Runs omniidl for one file; sources are named in the variable OUT.
function(tandem_run_omniidl out idl directory)
  cmake_parse_arguments(arg "" "" "INCLUDE_DIRS" ${ARGN})
  get_filename_component(base ${idl} NAME_WE)
  get_filename_component(idl ${idl} ABSOLUTE)
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
"// Made from ${base}.idl; changes are lost.\n#include \"${base}${kind}.h\"\n#include \"${base}SK.cc\"\n#include \"${base}DynSK.cc\"\n")
  endforeach()
  add_custom_command(
    OUTPUT ${directory}/${base}.hh ${directory}/${base}SK.cc ${directory}/${base}DynSK.cc
           ${directory}/${base}Signatures.cpp
    COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1
            ${OMNIIDL} -nf -p${TANDEM_RTM_IDL_TOOLS} -bcxx -Wba -Wbuse_quotes -Wbh=.hh -Wbs=SK.cc -Wbd=DynSK.cc
            -btandem_signatures -C${directory} ${includes} ${idl}
    DEPENDS ${idl} ${TANDEM_RTM_IDL_TOOLS}/tandem_signatures.py
    COMMENT "omniidl ${base}.idl" VERBATIM)
  set_source_files_properties(
    ${directory}/${base}SK.cc ${directory}/${base}DynSK.cc ${directory}/${base}Skel.cpp
    ${directory}/${base}Signatures.cpp PROPERTIES COMPILE_OPTIONS -w SKIP_LINTING ON)
  set_source_files_properties(${directory}/${base}Skel.cpp PROPERTIES
    OBJECT_DEPENDS "${directory}/${base}SK.cc;${directory}/${base}DynSK.cc;${directory}/${base}.hh")
  set(${out} ${directory}/${base}.hh ${directory}/${base}SK.cc ${directory}/${base}DynSK.cc
      ${directory}/${base}Skel.cpp ${directory}/${base}Signatures.cpp PARENT_SCOPE)
endfunction()

function(tandem_add_rtm_idl target)
  cmake_parse_arguments(arg "" "" "INCLUDE_DIRS" ${ARGN})
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/${target}_idl)
  foreach(idl ${arg_UNPARSED_ARGUMENTS})
    tandem_run_omniidl(sources ${idl} ${directory}
      INCLUDE_DIRS ${arg_INCLUDE_DIRS} ${TANDEM_RTM_IDL_TOOLS} ${TANDEM_RTM_IDL_INCLUDE})
    list(FILTER sources EXCLUDE REGEX "SK.cc$")
    target_sources(${target} PRIVATE ${sources})
  endforeach()
  target_include_directories(${target} SYSTEM PRIVATE ${directory})
endfunction()
