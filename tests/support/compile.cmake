# SPDX-License-Identifier: Apache-2.0
# cmake -DCOMPILER=... -DSTANDARD=14 -DINCLUDE=dir (-DSOURCE=file | -DFOLDER=folder -DSCRATCH=file) -P compile.cmake
# Compiles the source without a warning, or each header of the folder by itself, which takes a minute. FLAGS: further ones,
# with blanks between.
separate_arguments(FLAGS)
function(compile)
  execute_process(COMMAND ${COMPILER} -std=c++${STANDARD} -Wall -Wextra -Werror -fsyntax-only -I${INCLUDE} ${FLAGS} ${ARGN}
    RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(result)
    message(FATAL_ERROR "${ARGN} does not compile with ${COMPILER} as C++${STANDARD}:\n${errors}")
  endif()
endfunction()
if(SOURCE)
  compile(${SOURCE})
  return()
endif()
file(GLOB headers RELATIVE ${INCLUDE} ${INCLUDE}/${FOLDER}/*.h)
if(NOT headers)
  message(FATAL_ERROR "no header in ${INCLUDE}/${FOLDER}")
endif()
file(WRITE ${SCRATCH} "")
foreach(header ${headers})
  compile(-include ${header} -x c++ ${SCRATCH})
endforeach()
