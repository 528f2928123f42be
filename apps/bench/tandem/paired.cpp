// SPDX-License-Identifier: Apache-2.0
// Tandem's ring in ratio to its floors, measured in alternation with them (paired.hpp): what the acceptance limits use.
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/baseline/index_ring_endpoint.hpp"
#include "apps/bench/baseline/line_endpoint.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"

namespace tandem::bench {

void add_paired_cases(Registry& registry) {
    const auto add = [&](std::size_t bytes, Wake wake, void (*run)(Session&)) {
        registry.add({.subject = "ring",
                      .operation = "paired",
                      .bytes = bytes,
                      .wake = wake,
                      .unit = Unit::ratio,
                      .run = run});
    };
    // 48 bytes and their header fill one cache line; so does the word of the floor.
    add(48, Wake::spin, measure_paired_round_trips<RingEndpoint<48, Wake::spin>, LineEndpoint>);
    using Floor = IndexRingEndpoint<64, Wake::spin>;
    add(64, Wake::spin, measure_paired_round_trips<RingEndpoint<64, Wake::spin>, Floor>);
    // Awake: the next message comes before the reader would sleep.
    add(64, Wake::spin_then_futex,
        measure_paired_round_trips<RingEndpoint<64, Wake::spin_then_futex>, Floor>);
}

} // namespace tandem::bench
