// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

/// Times work(1), work(2), ... one after the other, for cases that are alone in their process. between(value),
/// which is not timed, runs before each.
template <class Work, class Between>
void time_each_call(Session& session, Work&& work, Between&& between) {
    const auto loop = [&] {
        for (double value = 1; session.needs_more(); ++value) {
            between(value);
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

template <class Work>
void time_each_call(Session& session, Work&& work) {
    time_each_call(session, work, [](double) {});
}

/// For events: polls the clock for this time, so that the thread to be woken sleeps again. The core of this
/// thread stays awake, like that of a component that computes.
inline void busy_wait(double ns) {
    const std::uint64_t pause = to_ticks(ns);
    for (const std::uint64_t begin = ticks(); ticks() - begin < pause;) {
    }
}

} // namespace tandem::bench
