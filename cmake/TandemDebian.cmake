# SPDX-License-Identifier: Apache-2.0
# Debian packages: `cpack -G DEB` in a built tree. The whole tree is installed once into a stage (debian/stage.cmake); each
# package takes from it what its list in debian/install names (debian/take.cmake), so that `cmake --install --component
# opros|rtm`, whose parts overlap, stays as it is.
set(debian ${PROJECT_SOURCE_DIR}/cmake/debian)
set(TANDEM_DEB_REVISION 0tandem1 CACHE STRING "Revision of the Debian packages: below those that Debian would have")
mark_as_advanced(TANDEM_DEB_REVISION)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tandem)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Tandem maintainers <maintainers@tandem.invalid>")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_THREADS 0)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${TANDEM_DEB_REVISION})
set(CPACK_DEBIAN_PACKAGE_SOURCE tandem)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Where dpkg-shlibdeps finds our own libraries; tandem_deb_package() names the packages that have them.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_TANDEM_EMULATOR ${CMAKE_CROSSCOMPILING_EMULATOR}) # runs the programs for their man pages; empty: none
set(CPACK_INSTALL_SCRIPTS ${debian}/stage.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${debian}/check_stage.cmake)
set(CPACK_TANDEM_BUILD ${PROJECT_BINARY_DIR}) # for these two
set(CPACK_TANDEM_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_COMPONENTS_ALL "")
set(own "(= ${PROJECT_VERSION}-${TANDEM_DEB_REVISION})")
if(CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${TANDEM_DEB_ARCHITECTURE})
  set(architecture ${TANDEM_DEB_ARCHITECTURE})
else()
  execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET) # without dpkg cpack makes no Debian package either
endif()

# tandem_deb_package(NAME SECTION s SUMMARY line DESCRIPTION text [DEPENDS x ...] [RECOMMENDS x ...] [SUGGESTS x ...]
#                    [CONFLICTS x ...] [NO_PROGRAMS])
# A package with the files that debian/install/NAME names, and the maintainer scripts of debian/control/NAME.
function(tandem_deb_package name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_PROGRAMS" "SECTION;SUMMARY;DESCRIPTION" "DEPENDS;RECOMMENDS;SUGGESTS;CONFLICTS")
  string(TOUPPER ${name} id)
  set(id CPACK_DEBIAN_${id})
  set(${id}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(${id}_PACKAGE_SECTION ${arg_SECTION} PARENT_SCOPE)
  if(name MATCHES "^lib") # so that `apt install ./tandem*.deb` finds what the other packages depend on
    set(${id}_FILE_NAME tandem-${name}_${PROJECT_VERSION}-${TANDEM_DEB_REVISION}_${architecture}.deb PARENT_SCOPE)
  endif()
  string(REPLACE CPACK_DEBIAN CPACK_COMPONENT component ${id})
  set(${component}_DESCRIPTION "${arg_SUMMARY}\n${arg_DESCRIPTION}" PARENT_SCOPE)
  foreach(relation DEPENDS RECOMMENDS SUGGESTS CONFLICTS)
    list(JOIN arg_${relation} ", " packages)
    string(REGEX REPLACE "(tandem-[a-z-]+)" "\\1 ${own}" packages "${packages}")
    set(${id}_PACKAGE_${relation} "${packages}" PARENT_SCOPE)
  endforeach()
  if(arg_NO_PROGRAMS) # dpkg-shlibdeps would find nothing, after a long look at each file
    set(${id}_PACKAGE_SHLIBDEPS OFF PARENT_SCOPE)
  endif()
  file(GLOB scripts CONFIGURE_DEPENDS ${debian}/control/${name}/*)
  set(${id}_PACKAGE_CONTROL_EXTRA "${scripts}" PARENT_SCOPE)
  install(CODE "
    set(package ${name})
    set(build \"${PROJECT_BINARY_DIR}\")
    set(libdir \"${CMAKE_INSTALL_LIBDIR}\")
    include(\"${debian}/take.cmake\")" COMPONENT ${name} EXCLUDE_FROM_ALL)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${name} PARENT_SCOPE)
endfunction()

include(debian/packages)
include(CPack)
