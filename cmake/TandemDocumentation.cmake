# SPDX-License-Identifier: Apache-2.0
# The documentation: in the installed tree and, at the same place relative to the programs, in the build tree. Messages of
# the programs name its pages. Their folders are those of the source tree, so that links between pages work.
set(documentation ${CMAKE_INSTALL_DATADIR}/doc/tandem)
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*)
list(APPEND pages README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md
  apps/bench/README.md apps/bench/interface_types/README.md apps/tandem/README.md apps/tandem/rtm/README.md
  apps/wheelchair/README.md host/call/README.md host/opros/README.md host/opros/YOUR_COMPONENT.md host/rt/README.md
  host/rtm/DIFFERENCES.md host/rtm/YOUR_COMPONENT.md plugins/devices/README.md proxy/link/README.md proxy/two_hosts.svg
  shm/README.md)
foreach(page IN LISTS pages)
  configure_file(${PROJECT_SOURCE_DIR}/${page} ${PROJECT_BINARY_DIR}/${documentation}/${page} COPYONLY)
  get_filename_component(folder ${page} DIRECTORY)
  foreach(component opros rtm)
    install(FILES ${page} DESTINATION ${documentation}/${folder} COMPONENT ${component})
  endforeach()
endforeach()
