// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/conductor.hpp"

#include <algorithm>

#include "apps/wheelchair/run/wiring.hpp"

namespace tandem::wheelchair {

namespace {

bool among(const std::vector<Member>& members, const std::string& name) {
    return std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.name == name; });
}

} // namespace

Conductor::Conductor(const RunDirectory& run, Configuration configuration) {
    for (const auto& host : run.hosts())
        hosts_[host.name] =
            std::make_unique<rt::StepClient>(run.step_socket(host.name), std::chrono::seconds(5));
    for (const char* component : {"JoystickComp", "ControlComp", "HWComp"}) {
        if (among(opros_members(configuration), component))
            seats_.push_back({hosts_["opros_host"].get(), component});
        else
            seats_.push_back({hosts_["rtm_host"].get(), std::string(component) + "0"});
    }
}

void Conductor::tick(bool last) {
    for (std::size_t i = 0; i + (last ? 1 : 0) < seats_.size(); ++i) seats_[i].host->step(seats_[i].instance);
}

} // namespace tandem::wheelchair
