// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/stepped_hosts.hpp"

#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace tandem::command {
namespace {

using namespace std::chrono_literals;

constexpr unsigned steps_between_looks = 100; // each poll costs a few system calls
constexpr auto grace = 20s;

RunOptions run_options(const ReplayOptions& options) {
    RunOptions run;
    run.folder = options.lockstep;
    run.plugin_dirs = options.plugin_dirs;
    run.wait_s = options.wait_s;
    run.strict = true; // a port that cannot be connected ends the replay
    return run;
}

} // namespace

SteppedHosts::SteppedHosts(const ReplayOptions& options, const std::string& replaced_host)
    : options_(options), replaced_host_(replaced_host), folder_(find_run_folder(options.lockstep)) {
    const bool stays =
        replaced_host == "opros_host" ? !folder_.rtc_conf.empty() : !folder_.application.empty();
    if (!stays)
        throw std::runtime_error(fmt::format("{} has only {}, which the replay replaces",
                                             options.lockstep.string(), replaced_host));
}

void SteppedHosts::start() {
    supervisor_.emplace();
    for (auto command : host_commands(folder_, run_options(options_))) {
        if (command.name == replaced_host_) continue;
        command.command.insert(command.command.end(), {"--lockstep", steps_.socket(command.name)});
        supervisor_->start(command);
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(options_.wait_s);
    const auto all_ready = [&] {
        const auto& hosts = supervisor_->hosts();
        return std::all_of(hosts.begin(), hosts.end(), [](const auto& host) { return host.ready(); });
    };
    while (!all_ready()) {
        handle(supervisor_->watch(50ms));
        if (std::chrono::steady_clock::now() >= deadline)
            throw std::runtime_error(
                fmt::format("{} was not ready within {:g} s; allow more time with --wait",
                            supervisor_->hosts().front().name, options_.wait_s));
    }
}

void SteppedHosts::handle(const hosts::Supervisor::Events& events) {
    for (const auto& [host, line] : events.lines)
        std::fputs(fmt::format("{:<10} | {}\n", host->name, replace_control_characters(line)).c_str(),
                   stdout);
    std::fflush(stdout);
    if (stopping_) return;
    if (events.interrupted) throw hosts::Interrupted();
    for (auto* host : events.ended)
        throw std::runtime_error(fmt::format("{} (pid {}) {}{}", host->name, host->process.pid(),
                                             host->process.poll()->text(),
                                             host->ready() ? "" : " before it was ready"));
}

void SteppedHosts::step(const std::string& host, const std::string& component) {
    steps_.step(host, component);
    if (++steps_since_look_ % steps_between_looks == 0) look();
}

void SteppedHosts::look() { handle(supervisor_->watch(0ms)); }

bool SteppedHosts::stop() {
    if (!supervisor_ || stopping_) return true;
    stopping_ = true;
    return supervisor_->stop_all(grace, [this](const auto& events) { handle(events); });
}

const std::vector<SteppedComponent>& SteppedHosts::find_components() {
    components_ = find_stepped_components(folder_, run_options(options_));
    for (const auto& each : components_)
        if (each.period.count() > 0 && (tick_.count() == 0 || each.period < tick_)) tick_ = each.period;
    if (tick_.count() == 0)
        throw std::runtime_error("--lockstep: no component has a period, so there are no ticks to run");
    std::erase_if(components_, [&](const auto& each) { return each.host == replaced_host_; });
    return components_;
}

} // namespace tandem::command
