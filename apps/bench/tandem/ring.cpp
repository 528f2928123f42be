// SPDX-License-Identifier: Apache-2.0
// Our ring, one way, by size and wake mode.
#include "apps/bench/tandem/ring_endpoint.hpp"

#include "apps/bench/harness/cases.hpp"

namespace tandem::bench {

namespace {

Case base(const char* operation, std::size_t bytes, Wake wake) {
    Case entry;
    entry.subject = "ring";
    entry.operation = operation;
    entry.bytes = bytes;
    entry.wake = wake;
    return entry;
}

template <Wake wake>
void add_wake(Registry& registry) {
    Case entry = base("one-way", 64, wake);
    entry.divisor = 2;
    entry.run = measure_round_trips<RingEndpoint<64, wake>>;
    registry.add_regimes(entry);
    if (wake != Wake::blocking) {
        entry.placement = Placement::threads;
        registry.cases.push_back(entry);
        entry.placement = Placement::processes;
    }
    entry.regime = Regime::loaded;
    registry.cases.push_back(entry);

    Case due = base("paced", 64, wake);
    due.run = measure_paced<RingEndpoint<64, wake>>;
    registry.cases.push_back(due);
    Case cost = base("publish", 64, wake);
    cost.run = measure_publish<RingEndpoint<64, wake>>;
    registry.cases.push_back(cost);
}

template <std::size_t bytes>
void add_size(Registry& registry) {
    Case entry = base("one-way", bytes, Wake::spin);
    entry.divisor = 2;
    entry.run = measure_round_trips<RingEndpoint<bytes, Wake::spin>>;
    registry.cases.push_back(entry);
}

} // namespace

void add_tandem_ring_cases(Registry& registry) {
    add_size<8>(registry);
    add_size<48>(registry);
    add_wake<Wake::spin>(registry);
    add_wake<Wake::spin_then_futex>(registry);
    add_wake<Wake::blocking>(registry);
    add_size<256>(registry);
    add_size<1024>(registry);
    add_size<4096>(registry);
    add_size<65536>(registry);
    add_size<1 << 20>(registry);
    add_size<6 << 20>(registry);
}

} // namespace tandem::bench
