// SPDX-License-Identifier: Apache-2.0
// The ratio of Tandem's ring to its floors, measured in alternation with them (paired.hpp), for the
// acceptance limits.
#include "apps/bench/measurements/paired.hpp"
#include "apps/bench/baseline/index_ring_endpoint.hpp"
#include "apps/bench/baseline/line_endpoint.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/tandem/ring_endpoint.hpp"

namespace tandem::bench {

void add_paired_cases(Registry& registry) {
    Case paired{.subject = "ring", .operation = "paired", .unit = Unit::ratio, .extra_seconds = 10};
    const auto add = [&](std::size_t bytes, Wake wake, void (*run)(Session&)) {
        paired.bytes = bytes;
        paired.wake = wake;
        paired.run = run;
        registry.add(paired);
    };
    // 48 bytes and their header fill one cache line; so does the word of the floor.
    add(48, Wake::spin, measure_paired_round_trips<RingEndpoint<48, Wake::spin>, LineEndpoint>);
    using PollingFloor = IndexRingEndpoint<64, Wake::spin>;
    using SleepingFloor = IndexRingEndpoint<64, Wake::blocking>;
    add(64, Wake::spin, measure_paired_round_trips<RingEndpoint<64, Wake::spin>, PollingFloor>);
    // Awake: the next message arrives before the reader would sleep.
    add(64, Wake::spin_then_futex,
        measure_paired_round_trips<RingEndpoint<64, Wake::spin_then_futex>, PollingFloor>);
    const auto asleep = measure_paired_round_trips<RingEndpoint<64, Wake::blocking>, SleepingFloor>;
    add(64, Wake::blocking, asleep);
    paired.power_profile = PowerProfile::low_latency_idle;
    add(64, Wake::blocking, asleep);
    // On one core, the wait mode is same-core, which yields before it sleeps.
    paired.power_profile = PowerProfile::normal;
    paired.placement = Placement::same_core;
    add(64, Wake::spin_then_futex,
        measure_paired_round_trips<RingEndpoint<64, Wake::spin_then_futex>, SleepingFloor>);
}

} // namespace tandem::bench
