# SPDX-License-Identifier: Apache-2.0
# Builds the RTCs alone, for OpenRTM-aist 2.1 as found by find_package(OpenRTM) (docs/real_engines.md).
find_package(OpenRTM REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_program(OMNIIDL omniidl REQUIRED)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
get_filename_component(tree ${CMAKE_CURRENT_SOURCE_DIR}/../../.. ABSOLUTE)
set(idl ${CMAKE_CURRENT_BINARY_DIR}/idl)
file(WRITE ${idl}/WheelchairSkel.h "#include \"Wheelchair.hh\"\n")
file(WRITE ${idl}/WheelchairSkel.cpp "#include \"WheelchairSK.cc\"\n#include \"WheelchairDynSK.cc\"\n")
add_custom_command(OUTPUT ${idl}/Wheelchair.hh ${idl}/WheelchairSK.cc ${idl}/WheelchairDynSK.cc
  COMMAND ${OMNIIDL} -bcxx -Wba -Wbuse_quotes -C${idl} ${CMAKE_CURRENT_SOURCE_DIR}/Wheelchair.idl
  DEPENDS Wheelchair.idl VERBATIM)
set_source_files_properties(${idl}/WheelchairSkel.cpp PROPERTIES OBJECT_DEPENDS "${idl}/WheelchairSK.cc;${idl}/WheelchairDynSK.cc")

file(GLOB core ${tree}/plugins/wheelchair/core/*/*.cpp)
add_library(wheelchair STATIC ${core} ${idl}/Wheelchair.hh ${idl}/WheelchairSkel.cpp)
target_include_directories(wheelchair PUBLIC ${tree})
target_include_directories(wheelchair SYSTEM PUBLIC ${idl} ${OPENRTM_INCLUDE_DIRS})
target_compile_options(wheelchair PUBLIC -ffp-contract=off) # as in core/
target_link_directories(wheelchair PUBLIC ${OPENRTM_LIBRARY_DIRS})
target_link_libraries(wheelchair PUBLIC Eigen3::Eigen ${OPENRTM_LIBRARIES})
foreach(component JoystickComp ControlComp HWComp)
  add_library(${component} MODULE ${component}.cpp)
  target_link_libraries(${component} PRIVATE wheelchair)
  set_target_properties(${component} PROPERTIES PREFIX "")
endforeach()
