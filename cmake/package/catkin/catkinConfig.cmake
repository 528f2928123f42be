# SPDX-License-Identifier: Apache-2.0
# find_package(catkin COMPONENTS rtmbuild) for packages of RT-Components, without catkin: what their CMakeLists.txt call of
# catkin and rtmbuild. Found only when it is named: cmake -Dcatkin_DIR=PREFIX/lib/cmake/Tandem/catkin
# Further components are packages of ROS, as Debian has roscpp, tf2 and messages: they are linked as catkin does.
# Headers made from idl/X.idl are PROJECT/idl/X.hh, XSkel.h and XStub.h below devel/include, as with catkin.
cmake_policy(VERSION 3.16) # packages ask for older ones
find_package(Tandem REQUIRED COMPONENTS rtm PATHS ${CMAKE_CURRENT_LIST_DIR}/.. NO_DEFAULT_PATH)
foreach(component ${catkin_FIND_COMPONENTS})
  if(component MATCHES "^(rtmbuild|openrtm_tools|openrtm_aist|openrtm_ros_bridge|message_generation|message_runtime)$")
    continue()
  endif()
  find_package(${component} QUIET CONFIG)
  # Packages name std_msgs for the bridges, which are not made.
  if(NOT ${component}_FOUND AND NOT component STREQUAL "std_msgs")
    string(REPLACE _ - package ${component})
    set(catkin_FOUND FALSE)
    set(catkin_NOT_FOUND_MESSAGE
      "the package needs '${component}' of ROS, which is not installed:\n  apt install lib${package}-dev, if Debian has it")
    return()
  endif()
endforeach()
set(catkin_FOUND TRUE)
set(CATKIN_DEVEL_PREFIX ${CMAKE_BINARY_DIR}/devel)
set(CATKIN_PACKAGE_BIN_DESTINATION lib/${PROJECT_NAME})
set(CATKIN_PACKAGE_LIB_DESTINATION lib)
set(CATKIN_PACKAGE_INCLUDE_DESTINATION include/${PROJECT_NAME})
set(CATKIN_PACKAGE_SHARE_DESTINATION share/${PROJECT_NAME})
set(catkin_INCLUDE_DIRS ${CATKIN_DEVEL_PREFIX}/include)
set(catkin_LIBRARIES "")
# In a second loop, because roscpp looks for catkin itself, which sets these variables.
foreach(component ${catkin_FIND_COMPONENTS})
  list(APPEND catkin_INCLUDE_DIRS ${${component}_INCLUDE_DIRS})
  list(APPEND catkin_LIBRARIES ${${component}_LIBRARIES})
endforeach()
foreach(list catkin_INCLUDE_DIRS catkin_LIBRARIES)
  list(REMOVE_DUPLICATES ${list})
endforeach()
if(NOT CMAKE_CXX_STANDARD)
  set(CMAKE_CXX_STANDARD 14) # the last with exception specifications, which older components use
endif()
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# What concerns only packages of ROS has no effect.
foreach(name catkin_package catkin_python_setup catkin_install_python add_message_files add_service_files
    generate_messages add_rostest)
  cmake_language(EVAL CODE "macro(${name})\nendmacro()")
endforeach()

macro(rtmbuild_init)
  include_directories(${catkin_INCLUDE_DIRS} ${CATKIN_DEVEL_PREFIX}/include/${PROJECT_NAME}/idl)
endmacro()

# The library PROJECT_idl, with which everything is linked that rtmbuild_add_...() adds later.
macro(rtmbuild_genidl)
  set(rtmbuild_sources "")
  file(GLOB rtmbuild_idls CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/idl/*.idl)
  foreach(rtmbuild_idl ${rtmbuild_idls})
    tandem_run_omniidl(rtmbuild_made ${rtmbuild_idl} ${CATKIN_DEVEL_PREFIX}/include/${PROJECT_NAME}/idl
      INCLUDE_DIRS ${PROJECT_SOURCE_DIR}/idl ${TANDEM_RTM_IDL_TOOLS} ${TANDEM_RTM_IDL_INCLUDE})
    list(APPEND rtmbuild_sources ${rtmbuild_made})
  endforeach()
  foreach(rtmbuild_target genrpc genidl genhh gencpp genbridge)
    add_custom_target(RTMBUILD_${PROJECT_NAME}_${rtmbuild_target})
  endforeach()
  if(rtmbuild_sources)
    add_library(${PROJECT_NAME}_idl SHARED ${rtmbuild_sources})
    target_link_libraries(${PROJECT_NAME}_idl Tandem::rtm)
    add_dependencies(RTMBUILD_${PROJECT_NAME}_genrpc ${PROJECT_NAME}_idl)
    add_dependencies(RTMBUILD_${PROJECT_NAME}_genhh ${PROJECT_NAME}_idl)
    install(TARGETS ${PROJECT_NAME}_idl LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  endif()
endmacro()

macro(rtmbuild_genbridge)
  message(STATUS "rtmbuild_genbridge: bridges to ROS are not made without catkin")
endmacro()

# Without keywords, since the packages themselves use target_link_libraries() so.
function(rtmbuild_link name)
  target_link_libraries(${name} Tandem::rtm)
  if(TARGET ${PROJECT_NAME}_idl)
    target_link_libraries(${name} ${PROJECT_NAME}_idl)
  endif()
endfunction()

function(rtmbuild_add_library name)
  add_library(${ARGV})
  rtmbuild_link(${name})
endfunction()

function(rtmbuild_add_executable name)
  add_executable(${ARGV})
  rtmbuild_link(${name})
endfunction()
