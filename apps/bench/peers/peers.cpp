// SPDX-License-Identifier: Apache-2.0
// Calls the function of each peer that this build has, and names the others. CMake writes peer_list.inc, one
// line for each tandem_bench_peer() of peers.cmake:
//     TANDEM_BENCH_PEER(iceoryx)                             add_iceoryx_cases() is in this build
//     TANDEM_BENCH_MISSING_PEER("iceoryx", "packages")       it is not: these Debian packages are missing
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"

namespace tandem::bench {

#define TANDEM_BENCH_PEER(name) void add_##name##_cases(Registry& registry);
#define TANDEM_BENCH_MISSING_PEER(name, packages)
#include "peer_list.inc"
#undef TANDEM_BENCH_PEER
#undef TANDEM_BENCH_MISSING_PEER

namespace {

/// Unused in a build that has all peers.
[[maybe_unused]] void skip(Registry& registry, const char* name, const char* packages) {
    registry.skipped.push_back({name, std::string("this build has no ") + name +
                                          ": install the Debian packages " + packages +
                                          " and build again (apps/bench/run.sh does both)"});
}

} // namespace

void add_peer_cases(Registry& registry) {
#define TANDEM_BENCH_PEER(name) add_##name##_cases(registry);
#define TANDEM_BENCH_MISSING_PEER(name, packages) skip(registry, name, packages);
#include "peer_list.inc"
}

} // namespace tandem::bench
