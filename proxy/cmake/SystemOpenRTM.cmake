# SPDX-License-Identifier: Apache-2.0
# tandem_rtm as an OpenRTM-aist 2.x that is installed. Its configuration file gives compiler flags as texts.
find_package(OpenRTM REQUIRED)
if(OPENRTM_VERSION VERSION_LESS 2.0)
  message(FATAL_ERROR "OpenRTM-aist ${OPENRTM_VERSION} in ${OpenRTM_DIR}: 2.0 or newer was expected, whose ports have messages "
    "as bytes; build with -DOpenRTM_DIR=FOLDER of OpenRTMConfig.cmake of a newer one")
endif()
# Signatures of IDL types and operations are found without the engine.
configure_file(${PROJECT_SOURCE_DIR}/host/rtm/include/rtm/InterfaceSignatures.h
  ${CMAKE_CURRENT_BINARY_DIR}/signatures/rtm/InterfaceSignatures.h COPYONLY)
add_library(tandem_rtm_signatures STATIC ${PROJECT_SOURCE_DIR}/host/rtm/runtime/port/interface_signatures.cpp)
target_include_directories(tandem_rtm_signatures PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/signatures)
target_link_libraries(tandem_rtm_signatures PUBLIC PkgConfig::OMNIORB)

add_library(tandem_rtm INTERFACE)
target_compile_definitions(tandem_rtm INTERFACE TANDEM_RTM_PUBLIC_API)
target_include_directories(tandem_rtm SYSTEM INTERFACE ${OPENRTM_INCLUDE_DIRS})
target_link_directories(tandem_rtm INTERFACE ${OPENRTM_LIBRARY_DIRS})
target_link_libraries(tandem_rtm INTERFACE tandem_rtm_signatures ${OPENRTM_LIBRARIES} PkgConfig::OMNIORB)
# What libtandem_rtm has for the proxy, too.
target_link_libraries(tandem_link PUBLIC tandem_call)
target_link_options(tandem_rtm INTERFACE -Wl,--no-undefined)
# The templates of its ports use operators of these headers, which must stand in front of them.
target_precompile_headers(tandem_rtm INTERFACE <rtm/idl/BasicDataTypeSkel.h>)
