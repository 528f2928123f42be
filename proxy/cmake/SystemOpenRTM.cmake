# SPDX-License-Identifier: Apache-2.0
# tandem_rtm as an OpenRTM-aist 2.x that is installed. Its configuration file gives compiler flags as texts.
find_package(OpenRTM REQUIRED)
if(OPENRTM_VERSION VERSION_LESS 2.0)
  message(FATAL_ERROR "OpenRTM-aist ${OPENRTM_VERSION} in ${OpenRTM_DIR}: expected 2.0 or newer, whose ports have messages "
    "as bytes; build with -DOpenRTM_DIR=FOLDER of OpenRTMConfig.cmake of a newer one")
endif()
# Signatures of IDL types and operations are found without the engine.
configure_file(${PROJECT_SOURCE_DIR}/host/rtm/include/rtm/InterfaceSignatures.h
  ${CMAKE_CURRENT_BINARY_DIR}/signatures/rtm/InterfaceSignatures.h COPYONLY)
add_library(tandem_rtm_signatures STATIC ${PROJECT_SOURCE_DIR}/host/rtm/runtime/port/interface_signatures.cpp)
target_include_directories(tandem_rtm_signatures PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/signatures)
target_link_libraries(tandem_rtm_signatures PUBLIC PkgConfig::OMNIORB)

# Names of libraries, which are no targets of this project.
list(TRANSFORM OPENRTM_LIBRARIES PREPEND "-l" REGEX "^[A-Za-z0-9_.+]+$")
add_library(tandem_rtm INTERFACE)
# Of 2.0.x one header is no C++20: a constructor is named by a template-id. The copy without it stands in front.
if(OPENRTM_VERSION VERSION_LESS 2.1)
  find_file(OPENRTM_CDR_STREAM rtm/CORBA_CdrMemoryStream.h PATHS ${OPENRTM_INCLUDE_DIRS} NO_DEFAULT_PATH REQUIRED)
  file(READ ${OPENRTM_CDR_STREAM} text)
  string(REPLACE "CORBA_CdrSerializer<DataType>(const" "CORBA_CdrSerializer(const" text "${text}")
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/corrected/rtm/CORBA_CdrMemoryStream.h "${text}")
  target_include_directories(tandem_rtm SYSTEM INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/corrected)
endif()
target_compile_definitions(tandem_rtm INTERFACE TANDEM_RTM_PUBLIC_API)
target_include_directories(tandem_rtm SYSTEM INTERFACE ${OPENRTM_INCLUDE_DIRS})
target_link_directories(tandem_rtm INTERFACE ${OPENRTM_LIBRARY_DIRS})
target_link_libraries(tandem_rtm INTERFACE tandem_rtm_signatures ${OPENRTM_LIBRARIES} PkgConfig::OMNIORB)
# What libtandem_rtm has for the proxy, too.
target_link_libraries(tandem_link PUBLIC tandem_call)
target_link_options(tandem_rtm INTERFACE -Wl,--no-undefined)
