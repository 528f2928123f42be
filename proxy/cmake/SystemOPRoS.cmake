# SPDX-License-Identifier: Apache-2.0
# tandem_opros as an OPRoS engine in the folder TANDEM_OPROS: its headers, and its component library, which is a part of each
# component. That is taken from the folder where it was built, or compiled from the engine's sources.
set(opros_headers ${TANDEM_OPROS}/include)
if(NOT EXISTS ${opros_headers}/OPRoSTypes.h)
  message(FATAL_ERROR "TANDEM_OPROS=${TANDEM_OPROS}: there is no include/OPRoSTypes.h; the folder of an OPRoS component engine was "
    "expected, with its headers in include/")
endif()
add_library(tandem_opros INTERFACE)
# One operator reads its constant operand by functions that are not constant. The copy without it stands in front.
file(READ ${opros_headers}/EventData.h text)
string(REPLACE "operator=(const EventData<dataType> &rhs)" "operator=(EventData<dataType> &rhs)" text "${text}")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/corrected/EventData.h "${text}")
target_include_directories(tandem_opros SYSTEM INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/corrected ${opros_headers}
  ${PROJECT_SOURCE_DIR}/host/call/include)
target_compile_definitions(tandem_opros INTERFACE TANDEM_OPROS_PUBLIC_API)

find_library(OPROS_CDL OPRoSCDL PATHS ${TANDEM_OPROS} PATH_SUFFIXES lib build NO_DEFAULT_PATH)
if(OPROS_CDL)
  target_link_libraries(tandem_opros INTERFACE ${OPROS_CDL})
else()
  file(GLOB opros_sources ${TANDEM_OPROS}/cdl/*.cpp ${TANDEM_OPROS}/src/archive/*.cpp)
  if(NOT opros_sources)
    message(FATAL_ERROR "TANDEM_OPROS=${TANDEM_OPROS}: there is neither libOPRoSCDL, here or in lib/ or build/, nor its sources in "
      "cdl/ and src/archive/; build the engine first, or give the folder of its sources")
  endif()
  add_library(tandem_opros_cdl STATIC ${opros_sources})
  # Sources of before C++17, with exception specifications; none of their warnings is for us.
  set_target_properties(tandem_opros_cdl PROPERTIES CXX_STANDARD 14)
  target_compile_options(tandem_opros_cdl PRIVATE -w)
  target_include_directories(tandem_opros_cdl SYSTEM PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/corrected ${opros_headers}
    ${TANDEM_OPROS}/cdl ${TANDEM_OPROS}/src)
  target_link_libraries(tandem_opros INTERFACE tandem_opros_cdl)
endif()
target_link_libraries(tandem_opros INTERFACE dl pthread)
target_link_libraries(tandem_link PUBLIC tandem_call)
# The engine unloads the libraries of a package that it stops; a thread of the shared memory's and its signal handler stay.
target_link_options(tandem_opros INTERFACE -Wl,--no-undefined -Wl,-z,nodelete)
