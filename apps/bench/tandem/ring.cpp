// SPDX-License-Identifier: Apache-2.0
// Our ring, one way, by size and wake mode.
#include "apps/bench/tandem/ring_endpoint.hpp"

#include "apps/bench/harness/cases.hpp"

namespace tandem::bench {

namespace {

Case base(const char* what, std::size_t bytes, Wake wake) {
    Case one;
    one.who = "ring";
    one.what = what;
    one.bytes = bytes;
    one.wake = wake;
    return one;
}

template <Wake wake>
void add_wake(Registry& registry) {
    Case one = base("one-way", 64, wake);
    one.divisor = 2;
    one.run = echo<OurRingEnd<64, wake>>;
    registry.add_regimes(one);
    if (wake != Wake::blocking) {
        one.placement = Placement::threads;
        registry.cases.push_back(one);
        one.placement = Placement::processes;
    }
    one.regime = Regime::loaded;
    registry.cases.push_back(one);

    Case due = base("paced", 64, wake);
    due.run = paced<OurRingEnd<64, wake>>;
    registry.cases.push_back(due);
    Case cost = base("publish", 64, wake);
    cost.run = publish<OurRingEnd<64, wake>>;
    registry.cases.push_back(cost);
}

template <std::size_t bytes>
void add_size(Registry& registry) {
    Case one = base("one-way", bytes, Wake::spin);
    one.divisor = 2;
    one.run = echo<OurRingEnd<bytes, Wake::spin>>;
    registry.cases.push_back(one);
}

} // namespace

void add_our_ring_cases(Registry& registry) {
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
