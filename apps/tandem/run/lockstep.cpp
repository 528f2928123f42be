// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/lockstep.hpp"

#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

std::vector<SteppedComponent> stepped_opros(const RunFolder& folder, const RunOptions& options) {
    std::vector<SteppedComponent> components;
    for (const auto& entry : find_node_part(folder, options).application.subcomponents) {
        const auto profile = engine::read_component_profile(entry.file);
        if (profile.execution_type != engine::ExecutionType::passive)
            components.push_back({"opros_host", entry.name, profile.period}); // period 0: in every tick
    }
    return components;
}

fs::path socket_folder() {
    std::string pattern = (fs::temp_directory_path() / "tandem-step-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
        throw std::runtime_error(pattern + " cannot be created: " + std::strerror(errno) +
                                 "; set TMPDIR to a writable folder");
    return pattern;
}

} // namespace

std::vector<SteppedComponent> find_stepped_components(const RunFolder& folder, const RunOptions& options) {
    std::vector<SteppedComponent> components;
    if (!folder.application.empty()) components = stepped_opros(folder, options);
    if (folder.rtc_conf.empty()) return components;
    for (const auto& rtc : probe_rtc_instances(folder.rtc_conf, {options.plugin_dirs, options.wait_s}))
        components.push_back({"rtm_host", rtc.name, rtc.period});
    return components;
}

Lockstep::Lockstep(std::vector<SteppedComponent> components) : components_(std::move(components)), tick_(0) {
    for (const auto& each : components_)
        if (each.period.count() > 0 && (tick_.count() == 0 || each.period < tick_)) tick_ = each.period;
    if (tick_.count() == 0)
        throw std::runtime_error("--lockstep: no component has a period, so there are no ticks to run");
}

HostSteps::HostSteps() : folder_(socket_folder()) {}

HostSteps::~HostSteps() {
    std::error_code ignored; // unused sockets may remain
    fs::remove_all(folder_, ignored);
}

double Lockstep::simulated_s() const {
    return static_cast<double>(ticks_) * std::chrono::duration<double>(tick_).count();
}

void HostSteps::step(const std::string& host, const std::string& component) {
    auto& client = hosts_[host];
    try {
        if (!client) client = std::make_unique<rt::StepClient>(socket(host), std::chrono::seconds(5));
        client->step(component);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cycle of " + component + " in " + host + ": " + error.what());
    }
}

void Lockstep::run_tick(const AfterStep& after_step) {
    // Returns the number of periods that end within `ticks`.
    const auto periods = [&](std::uint64_t ticks, std::chrono::nanoseconds period) {
        return static_cast<std::uint64_t>(tick_.count()) * ticks / static_cast<std::uint64_t>(period.count());
    };
    for (const auto& each : components_) {
        if (each.period.count() > 0 && periods(ticks_ + 1, each.period) == periods(ticks_, each.period))
            continue;
        hosts_.step(each.host, each.name);
        if (after_step) after_step(ticks_, each);
    }
    ++ticks_;
}

} // namespace tandem::command
