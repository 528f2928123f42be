# SPDX-License-Identifier: Apache-2.0
# The peers: other middleware, measured by the same harness. A peer NAME is one file NAME.cpp, which defines
# add_NAME_cases(), and one tandem_bench_peer() below. A peer that needs a package of peers.txt is optional: without the
# package, the program lists the peer as skipped.
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED CONFIG)

# tandem_bench_peer(NAME FOUND PACKAGES [LIBRARIES ...] [SOURCES more files...])
# Builds peers/NAME.cpp into the program if FOUND is true. PACKAGES: what to install otherwise.
set(TANDEM_BENCH_PEER_LIST "")
function(tandem_bench_peer name found packages)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  if(found)
    target_sources(tandem_bench_suite PRIVATE peers/${name}.cpp ${arg_SOURCES})
    target_link_libraries(tandem_bench_suite PRIVATE ${arg_LIBRARIES})
    string(APPEND TANDEM_BENCH_PEER_LIST "TANDEM_BENCH_PEER(${name})\n")
  else()
    message(STATUS "tandem-bench: without ${name} (Debian packages ${packages})")
    string(APPEND TANDEM_BENCH_PEER_LIST "TANDEM_BENCH_MISSING_PEER(\"${name}\", \"${packages}\")\n")
  endif()
  set(TANDEM_BENCH_PEER_LIST "${TANDEM_BENCH_PEER_LIST}" PARENT_SCOPE)
endfunction()

find_package(iceoryx_posh QUIET)
tandem_bench_peer(iceoryx "${iceoryx_posh_FOUND}" "libiceoryx-posh-dev iceoryx" LIBRARIES iceoryx_posh::iceoryx_posh)

tandem_bench_peer(boost TRUE libboost-dev LIBRARIES Boost::headers)
tandem_bench_peer(cyclictest TRUE rt-tests) # a program; looked for when it is to be measured
tandem_bench_peer(mqueue TRUE libc6-dev LIBRARIES rt)
tandem_bench_peer(unix_socket TRUE libc6-dev)

pkg_check_modules(ZEROMQ QUIET IMPORTED_TARGET libzmq)
tandem_bench_peer(zeromq "${ZEROMQ_FOUND}" libzmq3-dev LIBRARIES PkgConfig::ZEROMQ)

find_package(CycloneDDS QUIET)
find_program(CYCLONE_IDLC idlc)
set(cyclone_found FALSE)
if(CycloneDDS_FOUND AND CYCLONE_IDLC)
  set(cyclone_found TRUE)
  idlc_generate(TARGET tandem_bench_dds FILES peers/cyclone.idl)
endif()
tandem_bench_peer(cyclone ${cyclone_found} "cyclonedds-dev cyclonedds-tools" LIBRARIES tandem_bench_dds
  CycloneDDS::ddsc)

# omniORB is one of Tandem's own dependencies.
pkg_check_modules(OMNIORB REQUIRED IMPORTED_TARGET omniORB4)
find_program(OMNIIDL omniidl REQUIRED)
set(stubs ${CMAKE_CURRENT_BINARY_DIR}/omniorb)
file(MAKE_DIRECTORY ${stubs})
add_custom_command(
  OUTPUT ${stubs}/omniorb.hh ${stubs}/omniorbSK.cc
  COMMAND ${OMNIIDL} -bcxx -Wbuse_quotes -C${stubs} ${CMAKE_CURRENT_SOURCE_DIR}/peers/omniorb.idl
  DEPENDS peers/omniorb.idl COMMENT "omniidl omniorb.idl" VERBATIM)
set_source_files_properties(${stubs}/omniorbSK.cc PROPERTIES COMPILE_OPTIONS -w SKIP_LINTING ON)
tandem_bench_peer(omniorb TRUE libomniorb4-dev
  SOURCES ${stubs}/omniorb.hh ${stubs}/omniorbSK.cc LIBRARIES PkgConfig::OMNIORB)
target_include_directories(tandem_bench_suite SYSTEM PRIVATE ${stubs})
add_custom_target(bench_idl_headers DEPENDS ${stubs}/omniorb.hh) # for tests/lint.sh, as rtm_idl_headers
add_dependencies(tandem_bench_suite bench_idl_headers)

# Written only when it changes, so that peers.cpp is not compiled at each configuration.
file(CONFIGURE OUTPUT peers/peer_list.inc CONTENT "${TANDEM_BENCH_PEER_LIST}" @ONLY)
target_include_directories(tandem_bench_suite PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/peers)
