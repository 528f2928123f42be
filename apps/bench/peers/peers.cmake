# SPDX-License-Identifier: Apache-2.0
# The peers. Those of peers.txt are optional: each is built when CMake finds it, and otherwise named as skipped
# in the program's output.
find_package(PkgConfig REQUIRED)
find_package(Boost 1.74 REQUIRED)

# tandem_bench_peer(NAME FOUND WHAT-IS-MISSING SOURCES ... LIBRARIES ...)
function(tandem_bench_peer name found package)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  string(TOUPPER ${name} upper)
  if(found)
    target_sources(tandem_bench_suite PRIVATE ${arg_SOURCES})
    target_link_libraries(tandem_bench_suite PRIVATE ${arg_LIBRARIES})
    set_property(SOURCE peers/peers.cpp APPEND PROPERTY COMPILE_DEFINITIONS TANDEM_BENCH_${upper})
  else()
    message(STATUS "tandem-bench: without ${name} (Debian package ${package})")
  endif()
endfunction()

tandem_bench_peer(boost TRUE libboost-dev SOURCES peers/boost.cpp LIBRARIES Boost::headers)
tandem_bench_peer(mqueue TRUE libc6-dev SOURCES peers/mqueue.cpp LIBRARIES rt)
tandem_bench_peer(socket TRUE libc6-dev SOURCES peers/unix_socket.cpp)

find_package(iceoryx_posh QUIET)
tandem_bench_peer(iceoryx "${iceoryx_posh_FOUND}" libiceoryx-posh-dev
  SOURCES peers/iceoryx.cpp LIBRARIES iceoryx_posh::iceoryx_posh)

pkg_check_modules(ZEROMQ QUIET IMPORTED_TARGET libzmq)
tandem_bench_peer(zeromq "${ZEROMQ_FOUND}" libzmq3-dev SOURCES peers/zeromq.cpp LIBRARIES PkgConfig::ZEROMQ)

find_package(CycloneDDS QUIET)
find_program(CYCLONE_IDLC idlc)
if(CycloneDDS_FOUND AND CYCLONE_IDLC)
  idlc_generate(TARGET tandem_bench_dds FILES peers/cyclone.idl)
  tandem_bench_peer(cyclone TRUE cyclonedds-dev SOURCES peers/cyclone.cpp LIBRARIES tandem_bench_dds CycloneDDS::ddsc)
else()
  tandem_bench_peer(cyclone FALSE "cyclonedds-dev cyclonedds-tools")
endif()

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
  SOURCES peers/omniorb.cpp ${stubs}/omniorb.hh ${stubs}/omniorbSK.cc LIBRARIES PkgConfig::OMNIORB)
target_include_directories(tandem_bench_suite SYSTEM PRIVATE ${stubs})
