// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/lockstep_driver.hpp"

#include <algorithm>

#include "apps/wheelchair/run/topology.hpp"

namespace tandem::wheelchair {

namespace {

bool contains(const std::vector<RunComponent>& members, const std::string& name) {
    return std::any_of(members.begin(), members.end(), [&](const RunComponent& m) { return m.name == name; });
}

} // namespace

LockstepDriver::LockstepDriver(const RunDirectory& run, Configuration configuration) {
    for (const auto& host : run.hosts())
        hosts_[host.name] =
            std::make_unique<rt::StepClient>(run.step_socket(host.name), std::chrono::seconds(5));
    for (const char* component : {"JoystickComp", "ControlComp", "HWComp"}) {
        if (contains(opros_components(configuration), component))
            steps_.push_back({"opros_host", component});
        else
            // An RTC's instance name is its type and a number.
            steps_.push_back({"rtm_host", std::string(component) + "0"});
    }
}

void LockstepDriver::run_tick(bool last, const AfterStep& after_step) {
    for (std::size_t i = 0; i + (last ? 1 : 0) < steps_.size(); ++i) {
        hosts_.at(steps_[i].host)->step(steps_[i].instance);
        if (after_step) after_step(steps_[i].host, steps_[i].instance);
    }
}

} // namespace tandem::wheelchair
