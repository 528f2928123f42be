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
    set_property(SOURCE peers.cpp APPEND PROPERTY COMPILE_DEFINITIONS TANDEM_BENCH_${upper})
  else()
    message(STATUS "tandem-bench: without ${name} (Debian package ${package})")
  endif()
endfunction()

tandem_bench_peer(boost TRUE libboost-dev SOURCES peer_boost.cpp LIBRARIES Boost::headers)
tandem_bench_peer(mqueue TRUE libc6-dev SOURCES peer_mqueue.cpp LIBRARIES rt)
tandem_bench_peer(socket TRUE libc6-dev SOURCES peer_socket.cpp)

find_package(iceoryx_posh QUIET)
tandem_bench_peer(iceoryx "${iceoryx_posh_FOUND}" libiceoryx-posh-dev
  SOURCES peer_iceoryx.cpp LIBRARIES iceoryx_posh::iceoryx_posh)

pkg_check_modules(ZEROMQ QUIET IMPORTED_TARGET libzmq)
tandem_bench_peer(zeromq "${ZEROMQ_FOUND}" libzmq3-dev SOURCES peer_zeromq.cpp LIBRARIES PkgConfig::ZEROMQ)
