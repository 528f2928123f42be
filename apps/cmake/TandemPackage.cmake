# SPDX-License-Identifier: Apache-2.0
# The package that find_package(Tandem) finds: in the installed tree and, at the same place relative to the programs, in
# the build tree. `cmake --install build --component opros` installs what OPRoS components need and no more.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tandem)
set(package_source ${PROJECT_SOURCE_DIR}/apps/cmake/package)
set(package_built ${CMAKE_BINARY_DIR}/${package_dir})

configure_package_config_file(${package_source}/TandemConfig.cmake.in ${package_built}/TandemConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${package_built}/TandemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
configure_file(${package_source}/TandemOpros.cmake ${package_built}/TandemOpros.cmake COPYONLY)

install(TARGETS tandem_opros EXPORT TandemTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT opros)
install(EXPORT TandemTargets NAMESPACE Tandem:: DESTINATION ${package_dir} COMPONENT opros)
export(EXPORT TandemTargets NAMESPACE Tandem:: FILE ${package_built}/TandemTargets.cmake)
install(FILES ${package_built}/TandemConfig.cmake ${package_built}/TandemConfigVersion.cmake
  ${package_source}/TandemOpros.cmake DESTINATION ${package_dir} COMPONENT opros)
