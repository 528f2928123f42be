// SPDX-License-Identifier: Apache-2.0
// Which peers this build has (peers.cmake), and what is said of those that it has not.
#include "apps/bench/harness/cases.hpp"

#include "apps/bench/harness/case.hpp"

namespace tandem::bench {

namespace {

[[maybe_unused]] void skip(Registry& registry, const char* subject, const char* package) {
    registry.skipped.push_back({subject, std::string("this build has no ") + subject +
                                             ": install the Debian package " + package +
                                             " and build again (apps/bench/run.sh does both)"});
}

} // namespace

void add_peer_cases(Registry& registry) {
#ifdef TANDEM_BENCH_ICEORYX
    add_iceoryx_cases(registry);
#else
    skip(registry, "iceoryx", "libiceoryx-posh-dev");
#endif
    add_boost_cases(registry);
    add_cyclictest_cases(registry);
    add_mqueue_cases(registry);
    add_socket_cases(registry);
#ifdef TANDEM_BENCH_ZEROMQ
    add_zeromq_cases(registry);
#else
    skip(registry, "zeromq", "libzmq3-dev");
#endif
#ifdef TANDEM_BENCH_CYCLONE
    add_cyclone_cases(registry);
#else
    skip(registry, "cyclone-dds", "cyclonedds-dev");
#endif
#ifdef TANDEM_BENCH_OMNIORB
    add_omniorb_cases(registry);
#endif
}

} // namespace tandem::bench
