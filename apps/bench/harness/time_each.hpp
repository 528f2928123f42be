// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

/// Times work(1), work(2), ... one after the other, in the one process of a case that needs no second.
template <class Work>
void time_each_call(Session& session, Work&& work) {
    const auto loop = [&] {
        for (double value = 1; session.needs_more(); ++value) {
            const std::uint64_t before = ticks();
            work(value);
            const std::uint64_t now = ticks();
            session.add_sample(now - before, now);
        }
    };
    session.begin_warm_up();
    loop();
    session.begin_measuring();
    loop();
    session.end_measuring();
}

} // namespace tandem::bench
