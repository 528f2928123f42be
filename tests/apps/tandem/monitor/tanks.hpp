// SPDX-License-Identifier: Apache-2.0
// A host whose components have faults.
#pragma once
#include "apps/tandem/monitor/host_files/status_reader.hpp"
#include "apps/tandem/monitor/host_files/tick_reader.hpp"
#include "host/process/child_process.hpp"
#include "shm/os/clock.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::monitor::test {

/// A host with tanks of 10 ms and what a monitor sees of its ticks. The host is killed at the end: it may hang.
class Tanks {
  public:
    Tanks() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-hang-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~Tanks() {
        host_.reset();
        std::filesystem::remove_all(folder_);
    }
    Tanks(const Tanks&) = delete;
    Tanks& operator=(const Tanks&) = delete;

    /// The RTCs TankRtc0, ... with these faults.
    void start_rtm(const std::vector<std::string>& faults, const std::vector<std::string>& arguments = {}) {
        std::string names, active, settings;
        for (std::size_t i = 0; i < faults.size(); ++i) {
            const std::string tank = "TankRtc" + std::to_string(i);
            names += (i == 0 ? "" : ", ") + std::string("TankRtc");
            active += (i == 0 ? "" : ", ") + tank;
            settings += "test." + tank + ".conf.default.fault: " + faults[i] + "\n";
        }
        std::ofstream(folder_ / "rtc.conf")
            << "naming.enable: NO\nmanager.modules.load_path: " TANK_PLUGINS
               "\nmanager.modules.preload: TankRtc.so\nmanager.components.precreate: "
            << names << "\nmanager.components.preactivation: " << active << "\n"
            << settings << "exec_cxt.periodic.rate: 100\n";
        start("rtm_host", {RTM_HOST, "-f", folder_ / "rtc.conf"}, arguments);
    }
    /// The OPRoS components Tank0, ... with these faults, or "no library"; `type`: of their execution.
    void start_opros(const std::vector<std::string>& faults, const std::vector<std::string>& arguments = {},
                     const std::string& type = "periodic") {
        std::string components;
        for (std::size_t i = 0; i < faults.size(); ++i) {
            const std::string tank = "Tank" + std::to_string(i);
            std::ofstream(folder_ / (tank + ".xml"))
                << "<component_profile><name>" << tank << "</name><execution_environment><library_name>"
                << (faults[i] == "no library" ? "NoSuchComp" : "TankComp")
                << "</library_name>"
                   "</execution_environment><execution_semantics><type>"
                << type
                << "</type><period>10</period></execution_semantics><properties><property name=\"fault\">"
                << faults[i] << "</property></properties></component_profile>";
            components += "<subcomponent><name>" + tank + "</name><reference>" + tank +
                          ".xml</reference></subcomponent>";
        }
        std::ofstream(folder_ / "app.xml")
            << "<package_profile><name>app</name><subcomponents>" << components
            << "</subcomponents><port_connections></port_connections></package_profile>";
        start("opros_host", {OPROS_HOST, "--plugin-path", TANK_PLUGINS, folder_ / "app.xml"}, arguments);
    }

    /// Reads until the state of the host is as wanted, for a generous time.
    bool sees(const std::function<bool(const State&)>& wanted) {
        for (int i = 0; i < 300; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            if (wanted(look())) return true;
        }
        return false;
    }
    State look() {
        State state;
        state.time_ms = 1'000'000'000'000;
        state.links.emplace_back();
        state.links.back().sides[0] = state.links.back().sides[1] = {
            shm::PeerState::alive, static_cast<std::uint32_t>(host_->pid()), program_};
        ticks_.read(state, shm::now_ns());
        statuses_.read(state, shm::now_ns());
        return state;
    }
    std::size_t ticking(const State& state) const {
        return static_cast<std::size_t>(std::count_if(state.ticks.begin(), state.ticks.end(),
                                                      [](const auto& tick) { return tick.ticks > 30; }));
    }
    std::filesystem::path socket() const { return folder_ / "socket"; }

  private:
    void start(const std::string& program, std::vector<std::string> command,
               const std::vector<std::string>& arguments) {
        program_ = program;
        command.insert(command.end(), arguments.begin(), arguments.end());
        host_.emplace(command);
    }
    std::filesystem::path folder_;
    std::string program_;
    TickReader ticks_;
    StatusReader statuses_;
    std::optional<process::ChildProcess> host_;
};

} // namespace tandem::monitor::test
