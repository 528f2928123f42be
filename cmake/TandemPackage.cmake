# SPDX-License-Identifier: Apache-2.0
# The package that find_package(Tandem) finds: in the installed tree and, at the same place relative to the programs, in
# the build tree. `cmake --install build --component opros` installs what OPRoS components need and no more,
# `--component rtm` what RT-Components need.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tandem)
set(package_source ${PROJECT_SOURCE_DIR}/cmake/package)
set(package_built ${PROJECT_BINARY_DIR}/${package_dir})
set(package_installed ${PROJECT_BINARY_DIR}/package) # what differs in the installed tree

function(tandem_package_config file prefix)
  configure_package_config_file(${package_source}/TandemConfig.cmake.in ${file}
    INSTALL_DESTINATION ${package_dir} INSTALL_PREFIX ${prefix} PATH_VARS RTM_GENERATED_DIR RTM_CMAKE_DIR OPENCV1_DIR
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
endfunction()
set(RTM_GENERATED_DIR ${TANDEM_RTM_IDL_INCLUDE})
set(RTM_CMAKE_DIR ${PROJECT_SOURCE_DIR}/host/rtm/cmake)
set(OPENCV1_DIR ${package_source}/opencv1)
tandem_package_config(${package_built}/TandemConfig.cmake ${PROJECT_BINARY_DIR})
set(RTM_GENERATED_DIR ${CMAKE_INSTALL_INCLUDEDIR}/tandem/rtm)
set(RTM_CMAKE_DIR ${CMAKE_INSTALL_DATADIR}/tandem/rtm/cmake)
set(OPENCV1_DIR ${CMAKE_INSTALL_INCLUDEDIR}/tandem/opencv1)
tandem_package_config(${package_installed}/TandemConfig.cmake ${CMAKE_INSTALL_PREFIX})
write_basic_package_version_file(${package_built}/TandemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
foreach(file TandemOpros.cmake TandemRtm.cmake TandemComponent.cmake catkin/catkinConfig.cmake)
  configure_file(${package_source}/${file} ${package_built}/${file} COPYONLY)
endforeach()

# Separate sets of targets, because one may be installed without the other.
tandem_install(tandem_opros EXPORT TandemTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT opros)
tandem_install(tandem_rtm EXPORT TandemRtmTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT rtm)
install(EXPORT TandemTargets NAMESPACE Tandem:: DESTINATION ${package_dir} COMPONENT opros)
install(EXPORT TandemRtmTargets NAMESPACE Tandem:: DESTINATION ${package_dir} COMPONENT rtm)
export(EXPORT TandemTargets NAMESPACE Tandem:: FILE ${package_built}/TandemTargets.cmake)
export(EXPORT TandemRtmTargets NAMESPACE Tandem:: FILE ${package_built}/TandemRtmTargets.cmake)
install(FILES ${package_source}/TandemOpros.cmake DESTINATION ${package_dir} COMPONENT opros)
install(FILES ${package_source}/TandemRtm.cmake DESTINATION ${package_dir} COMPONENT rtm)
install(FILES ${package_source}/catkin/catkinConfig.cmake DESTINATION ${package_dir}/catkin COMPONENT rtm)
foreach(component opros rtm)
  install(FILES ${package_installed}/TandemConfig.cmake ${package_built}/TandemConfigVersion.cmake
    ${package_source}/TandemComponent.cmake DESTINATION ${package_dir} COMPONENT ${component})
  install(DIRECTORY ${package_source}/opencv1/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tandem/opencv1
    COMPONENT ${component} PATTERN "README.md" EXCLUDE)
  tandem_install(tandem RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
endforeach()
# The program `tandem` is linked with both libraries.
tandem_install(tandem_opros LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT rtm)
install(TARGETS tandem_rtm LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT opros OPTIONAL)
tandem_name_missing_at_install()
