# SPDX-License-Identifier: Apache-2.0
# cmake -DCOMPILER=... -DSTANDARD=14 -DINCLUDE=dir (-DSOURCE=file | -DFOLDER=folder -DSCRATCH=file) -P compile.cmake
# Compiles the source, or every header of the folder for itself, without a warning. FLAGS: further ones, with blanks
# between.
separate_arguments(FLAGS)
set(command ${COMPILER} -std=c++${STANDARD} -Wall -Wextra -Werror -fsyntax-only -I${INCLUDE} ${FLAGS})
function(compile)
  execute_process(COMMAND ${command} ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(result)
    message(FATAL_ERROR "${ARGN} does not compile with ${COMPILER} as C++${STANDARD}:\n${errors}")
  endif()
endfunction()
if(SOURCE)
  compile(${SOURCE})
else()
  file(GLOB headers RELATIVE ${INCLUDE} ${INCLUDE}/${FOLDER}/*.h)
  if(NOT headers)
    message(FATAL_ERROR "no header in ${INCLUDE}/${FOLDER}")
  endif()
  file(WRITE ${SCRATCH} "")
  foreach(header ${headers})
    compile(-include ${header} -x c++ ${SCRATCH})
  endforeach()
endif()
