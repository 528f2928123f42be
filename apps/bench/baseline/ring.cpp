// SPDX-License-Identifier: Apache-2.0
// The cases of the minimal ring (index_ring.hpp): one way, as a pair of rings for calls, and streams.
#include "apps/bench/baseline/index_ring_endpoint.hpp"
#include "apps/bench/baseline/stream_endpoints.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/measurements/cold.hpp"
#include "apps/bench/measurements/ring_cases.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::bench {

namespace {

/// Measures in 8 places of the memory, one after the other: see measure_round_trips_in_regions().
template <Wake wake>
void measure_in_8_regions(Session& session) {
    measure_round_trips_in_regions<IndexRingEndpoint<64, wake>>(session, 8);
}

/// A sleeps for the interval, writes the time into 48 bytes and sends them; B reads the clock when it has
/// received them. Both cores read the same clock, as in the cases of the bridge.
template <Wake wake>
void measure_cold(Session& session) {
    using Ring = IndexRing<64, 1024, wake>;
    Ring ring(session.memory().data());
    const int interval_ms = cold_interval_ms(session.bench_case());
    const std::size_t messages = cold_warm_up + cold_messages(session.budget(), interval_ms);
    std::uint64_t message[6] = {};
    request_priority();
    session.arrive_and_wait();
    if (session.is_side_a()) {
        ColdPacer pacer(interval_ms);
        for (std::size_t i = 0; i < messages; ++i) {
            pacer.sleep();
            message[0] = ticks();
            std::memcpy(ring.claim(), message, sizeof message);
            ring.publish();
        }
        return;
    }
    for (std::size_t i = 0; i < messages; ++i) {
        std::memcpy(message, ring.wait_for_slot(), sizeof message);
        const std::uint64_t now = ticks();
        ring.release();
        if (i >= cold_warm_up) session.add_result(to_ns(now - message[0]));
    }
}

/// Measures one way to a reader that has slept for 200 us, as event-driven components with infrequent messages
/// do: a core that has just gone to sleep wakes faster. A stays awake.
void measure_after_rest(Session& session) {
    using Ring = IndexRing<64, 1024, Wake::blocking>;
    using Replies = IndexRing<64, 1024, Wake::spin>; // A polls: it sends when B has taken the last message
    constexpr std::size_t page = 4096;
    Ring ring(session.memory().data());
    Replies replies(session.memory().data() + (Ring::memory_bytes + page) / page * page);
    const std::size_t messages = 100 + std::min<std::size_t>(session.budget().samples, 2000);
    std::uint64_t message[6] = {};
    session.arrive_and_wait();
    for (std::size_t i = 0; i < messages; ++i) {
        if (session.is_side_a()) {
            for (const std::uint64_t end = ticks() + to_ticks(200e3); ticks() < end;) {
            }
            message[0] = ticks();
            std::memcpy(ring.claim(), message, sizeof message);
            ring.publish();
            replies.wait_for_slot();
            replies.release();
        } else {
            std::memcpy(message, ring.wait_for_slot(), sizeof message);
            const std::uint64_t now = ticks();
            ring.release();
            replies.claim();
            replies.publish();
            if (i >= 100) session.add_result(to_ns(now - message[0]));
        }
    }
}

/// The share of the machine: the same loop with an empty body, which reads the clock twice after the sleep.
void measure_empty_loop(Session& session) {
    const int interval_ms = cold_interval_ms(session.bench_case());
    request_priority();
    ColdPacer pacer(interval_ms);
    for (std::size_t i = cold_messages(session.budget(), interval_ms); i > 0; --i) {
        pacer.sleep();
        const std::uint64_t before = ticks();
        session.add_result(to_ns(ticks() - before));
    }
}

void add_cold_cases(Registry& registry) {
    for (const int interval_ms : cold_intervals_ms) {
        Case cold{.group = Group::baseline,
                  .subject = "index-ring",
                  .operation = cold_operation(interval_ms),
                  .bytes = 48,
                  .extra_seconds = 10, // at 100 ms
                  .run = measure_cold<Wake::spin>};
        registry.add(cold);
        cold.wake = Wake::blocking;
        cold.run = measure_cold<Wake::blocking>;
        registry.add(cold);
        cold.subject = "empty-loop";
        cold.wake = Wake::none;
        cold.placement = Placement::alone;
        cold.run = measure_empty_loop;
        registry.add(cold);
    }
}

/// The 64-byte cases of one wake mode.
template <Wake wake>
void add_wake_mode(Registry& registry) {
    RingCases<IndexRingEndpoint>(registry, Group::baseline, "index-ring")
        .add_wake_mode<wake>(measure_in_8_regions<wake>);
    // A request and a reply, each in a ring: the minimum that a call needs.
    registry.add_with_conditions({.group = Group::baseline,
                                  .subject = "ring-pair",
                                  .operation = "call",
                                  .wake = wake,
                                  .run = measure_in_8_regions<wake>});
}

/// "zero-copy": fills and sums the slots themselves.
template <std::size_t bytes>
void add_large_streams(RingCases<IndexRingEndpoint>& cases) {
    cases.add_large_stream<IndexRingEndpoint<bytes, Wake::spin>>(bytes, "zero-copy");
    cases.add_large_stream<CopyingEndpoint<bytes>>(bytes, "copy");
}

} // namespace

void add_index_ring_cases(Registry& registry) {
    add_wake_mode<Wake::spin>(registry);
    add_wake_mode<Wake::spin_then_futex>(registry);
    add_wake_mode<Wake::blocking>(registry);
    add_cold_cases(registry);
    RingCases<IndexRingEndpoint> cases(registry, Group::baseline, "index-ring");
    cases.add_sizes_from_256();
    Case rested{.group = Group::baseline,
                .subject = "index-ring",
                .operation = "one-way",
                .wake = Wake::blocking,
                .detail = "rested",
                .run = measure_after_rest};
    registry.add(rested);
    rested.power_profile = PowerProfile::low_latency_idle;
    registry.add(rested);
    cases.add_small_stream<SmallStreamEndpoint>();
    add_large_streams<65536>(cases);
    add_large_streams<mebibyte>(cases);
    add_large_streams<6 * mebibyte>(cases);
}

} // namespace tandem::bench
