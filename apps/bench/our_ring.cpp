// SPDX-License-Identifier: Apache-2.0
// Our ring, one way, by size and wake mode.
#include "apps/bench/our_ring_end.hpp"

#include "apps/bench/cases.hpp"

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

} // namespace

void add_our_ring_cases(Registry& registry) {
    for (Wake wake : {Wake::spin, Wake::spin_then_futex, Wake::blocking}) {
        Case one = base("one-way", 64, wake);
        one.divisor = 2;
        one.run = echo<OurRingEnd>;
        registry.add_regimes(one);
        if (wake != Wake::blocking) {
            one.placement = Placement::threads;
            registry.cases.push_back(one);
            one.placement = Placement::processes;
        }
        one.regime = Regime::loaded;
        registry.cases.push_back(one);

        Case due = base("paced", 64, wake);
        due.run = paced<OurRingEnd>;
        registry.cases.push_back(due);
        Case cost = base("publish", 64, wake);
        cost.run = publish<OurRingEnd>;
        registry.cases.push_back(cost);
    }
    for (std::size_t bytes :
         {std::size_t{8}, std::size_t{48}, std::size_t{256}, std::size_t{1024}, std::size_t{4096},
          std::size_t{65536}, std::size_t{1} << 20U, std::size_t{6} << 20U}) {
        Case one = base("one-way", bytes, Wake::spin);
        one.divisor = 2;
        one.run = echo<OurRingEnd>;
        registry.cases.push_back(one);
    }
}

} // namespace tandem::bench
