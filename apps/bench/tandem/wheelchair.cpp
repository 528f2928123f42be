// SPDX-License-Identifier: Apache-2.0
// The paper's Table 1: JoystickComp's sending to ControlComp's reading while the wheelchair drives, with all
// components OPRoS, all RTM, and mixed across the bridge. Hosts on cores a and b, a message every 10 ms.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/power_profile.hpp"
#include "apps/bench/harness/session.hpp"

#include "apps/wheelchair/run/run.hpp"

#include <cstdio>
#include <sched.h>

namespace tandem::bench {

namespace {

constexpr double settling = 1.0; // s before the table's first sample

/// The core that each side was pinned to.
std::pair<int, int> cores_of_both(Session& session) {
    auto* cores = reinterpret_cast<int*>(session.memory().data());
    cores[session.is_a() ? 0 : 1] = sched_getcpu();
    session.arrive_and_wait();
    return {cores[0], cores[1]};
}

template <wheelchair::Configuration configuration>
void drive(Session& session) {
    const auto [a, b] = cores_of_both(session);
    if (session.is_a()) {
        // It tells its user about the hosts; this process has no user.
        if (std::freopen("/dev/null", "w", stdout) == nullptr)
            throw std::runtime_error("cannot open /dev/null");
        cpu_set_t both; // the hosts inherit it
        CPU_ZERO(&both);
        CPU_SET(a, &both);
        CPU_SET(b, &both);
        sched_setaffinity(0, sizeof both, &both);
        wheelchair::Options options;
        options.duration = settling + std::max(1.5, session.budget().seconds * 2);
        options.opros_cpu = a;
        options.rtm_cpu = b;
        const auto result = wheelchair::run(options, configuration);
        if (!result.failures.empty()) throw std::runtime_error(result.failures.front());
        const std::size_t first = std::min<std::size_t>(100, result.latencies.size());
        for (std::size_t i = first; i < result.latencies.size(); ++i)
            session.add_result(result.latencies[i] * 1e3);
    }
    session.arrive_and_wait();
}

} // namespace

void add_tandem_wheelchair_cases(Registry& registry) {
    Case entry;
    entry.subject = "wheelchair";
    entry.operation = "joystick-to-control";
    entry.detail = "opros";
    entry.run = drive<wheelchair::Configuration::opros>;
    registry.cases.push_back(entry);
    entry.detail = "rtm";
    entry.run = drive<wheelchair::Configuration::rtm>;
    registry.cases.push_back(entry);
    entry.detail = "mixed";
    entry.run = drive<wheelchair::Configuration::mixed>;
    registry.cases.push_back(entry);
}

} // namespace tandem::bench
