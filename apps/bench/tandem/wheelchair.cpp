// SPDX-License-Identifier: Apache-2.0
// The latency of the paper's Table 1, from JoystickComp's sending to ControlComp's reading, while the
// wheelchair drives: with all components OPRoS, all RTM, and mixed across the bridge. A message every 10 ms.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/harness/session.hpp"

#include "apps/wheelchair/run/run.hpp"

#include <cstdio>
#include <sched.h>

namespace tandem::bench {

namespace {

constexpr double settling_seconds = 1.0;      // the chair has reached its speed then
constexpr std::size_t settling_samples = 100; // number of messages in this time

/// The cores that A and B are pinned to. [both sides]
std::pair<int, int> cores_of_both(Session& session) {
    auto* cores = reinterpret_cast<int*>(session.memory().data());
    cores[session.is_side_a() ? 0 : 1] = sched_getcpu();
    session.arrive_and_wait();
    return {cores[0], cores[1]};
}

/// A runs the wheelchair, whose hosts get both cores; B only reserves its core for them.
template <wheelchair::Configuration configuration>
void drive(Session& session) {
    const auto [a, b] = cores_of_both(session);
    if (session.is_side_a()) {
        // The run prints its progress for a user, which would disturb the report.
        if (std::freopen("/dev/null", "w", stdout) == nullptr)
            throw std::runtime_error("cannot open /dev/null");
        cpu_set_t both; // the hosts inherit it
        CPU_ZERO(&both);
        CPU_SET(a, &both);
        CPU_SET(b, &both);
        sched_setaffinity(0, sizeof both, &both);
        wheelchair::Options options;
        options.duration = settling_seconds + std::max(1.5, session.budget().seconds * 2);
        options.opros_cpu = a;
        options.rtm_cpu = b;
        // Runs it as `wheelchair` does, with both hosts as child processes.
        const auto result = wheelchair::run(options, configuration);
        if (!result.failures.empty()) throw std::runtime_error(result.failures.front());
        const std::size_t first = std::min(settling_samples, result.latencies.size());
        for (std::size_t i = first; i < result.latencies.size(); ++i)
            session.add_result(result.latencies[i].us * 1e3);
    }
    session.arrive_and_wait();
}

} // namespace

void add_wheelchair_cases(Registry& registry) {
    const auto add = [&](const char* configuration, void (*run)(Session&)) {
        registry.add({.subject = "wheelchair",
                      .operation = "joystick-to-control",
                      .detail = configuration,
                      .run = run});
    };
    add("opros", drive<wheelchair::Configuration::opros>);
    add("rtm", drive<wheelchair::Configuration::rtm>);
    add("mixed", drive<wheelchair::Configuration::mixed>);
}

} // namespace tandem::bench
