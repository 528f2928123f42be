# SPDX-License-Identifier: Apache-2.0
# cmake -DCOMPILER=... -DSTANDARD=14 -DINCLUDE=dir -DSOURCE=file [-DEACH=1] -P compile.cmake
# Compiles the source, and with EACH every header for itself, without a warning.
set(command ${COMPILER} -std=c++${STANDARD} -Wall -Wextra -Werror -fsyntax-only -I${INCLUDE})
function(compile)
  execute_process(COMMAND ${command} ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE errors)
  if(result)
    message(FATAL_ERROR "${ARGN} does not compile with ${COMPILER} as C++${STANDARD}:\n${errors}")
  endif()
endfunction()
compile(${SOURCE})
if(EACH)
  file(GLOB headers RELATIVE ${INCLUDE} ${INCLUDE}/*.h ${INCLUDE}/archive/*.h ${INCLUDE}/device/*.h ${INCLUDE}/ext/*.h)
  file(WRITE ${SCRATCH} "")
  foreach(header ${headers})
    compile(-include ${header} -x c++ ${SCRATCH})
  endforeach()
endif()
