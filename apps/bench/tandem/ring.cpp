// SPDX-License-Identifier: Apache-2.0
// Tandem's ring, which carries each data port across a link: one way, by wake mode and size.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/measurements/ring_cases.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"

namespace tandem::bench {

void add_ring_cases(Registry& registry) {
    RingCases<RingEndpoint> cases(registry, Group::tandem, "ring");
    cases.add_size<8>();
    cases.add_size<48>(); // the longest that fits into one cache line with the record's header
    cases.add_wake_mode<Wake::spin>();
    cases.add_wake_mode<Wake::spin_then_futex>();
    cases.add_wake_mode<Wake::blocking>();
    cases.add_sizes_from_256();
}

} // namespace tandem::bench
