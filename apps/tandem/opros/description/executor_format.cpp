// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/description/executor_format.hpp"

#include <fmt/format.h>

namespace tandem::command {

std::string to_string(engine::ExecutionType execution) {
    switch (execution) {
    case engine::ExecutionType::periodic:
        return "periodic";
    case engine::ExecutionType::periodic_shared:
        return "periodic-shared";
    case engine::ExecutionType::aperiodic:
        return "aperiodic";
    case engine::ExecutionType::aperiodic_loop:
        return "aperiodic-loop";
    case engine::ExecutionType::passive:
        return "passive";
    }
    return "unknown";
}

// Times are in milliseconds, as in the profile.
std::string format_executor(const engine::ComponentProfile& profile) {
    std::string text = to_string(profile.execution_type);
    const auto ms = [](std::chrono::nanoseconds time) {
        return fmt::format("{} ms", static_cast<double>(time.count()) / 1e6);
    };
    // Omits zero and the default policy, which are the values of missing elements.
    if (profile.period.count() != 0) text += ", every " + ms(profile.period);
    if (profile.phase.count() != 0) text += ", phase " + ms(profile.phase);
    if (profile.priority != 0) text += fmt::format(", priority {}", profile.priority);
    if (profile.scheduling_policy != engine::SchedulingPolicy::other)
        text += profile.scheduling_policy == engine::SchedulingPolicy::fifo ? " (SCHED_FIFO)" : " (SCHED_RR)";
    return text;
}

} // namespace tandem::command
