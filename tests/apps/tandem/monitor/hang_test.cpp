// SPDX-License-Identifier: Apache-2.0
// What the monitor sees of hosts whose components hang.
#include "apps/tandem/monitor/host_files/tick_reader.hpp"
#include "apps/tandem/monitor/verdict.hpp"
#include "host/process/child_process.hpp"
#include "shm/os/clock.hpp"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace tandem::monitor;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A host with tanks of 10 ms and what a monitor sees of its ticks. The host is killed at the end: it may hang.
class Tanks {
  public:
    Tanks() {
        std::string name = (fs::temp_directory_path() / "tandem-hang-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~Tanks() {
        host_.reset();
        fs::remove_all(folder_);
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
    /// The OPRoS components Tank0, ... with these faults; `type`: of their execution.
    void start_opros(const std::vector<std::string>& faults, const std::vector<std::string>& arguments = {},
                     const std::string& type = "periodic") {
        std::string components;
        for (std::size_t i = 0; i < faults.size(); ++i) {
            const std::string tank = "Tank" + std::to_string(i);
            std::ofstream(folder_ / (tank + ".xml"))
                << "<component_profile><name>" << tank
                << "</name><execution_environment><library_name>TankComp</library_name>"
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

    /// Looks until the state of the host is as wanted, at most as long as is out of proportion.
    bool sees(const std::function<bool(const State&)>& wanted) {
        for (int i = 0; i < 300; ++i) {
            std::this_thread::sleep_for(100ms);
            if (wanted(look())) return true;
        }
        return false;
    }
    State look() {
        State state;
        state.time_ms = 1'000'000'000'000;
        state.links.emplace_back();
        state.links.back().sides[0] = state.links.back().sides[1] = {
            tandem::shm::PeerState::alive, static_cast<std::uint32_t>(host_->pid()), program_};
        reader_.read(state, tandem::shm::now_ns());
        return state;
    }
    std::size_t ticking(const State& state) const {
        return static_cast<std::size_t>(std::count_if(state.ticks.begin(), state.ticks.end(),
                                                      [](const auto& tick) { return tick.ticks > 30; }));
    }
    fs::path socket() const { return folder_ / "socket"; }

  private:
    void start(const std::string& program, std::vector<std::string> command,
               const std::vector<std::string>& arguments) {
        program_ = program;
        command.insert(command.end(), arguments.begin(), arguments.end());
        host_.emplace(command);
    }
    fs::path folder_;
    std::string program_;
    TickReader reader_;
    std::optional<tandem::process::ChildProcess> host_;
};

bool hangs(const State& state) { return judge(state).level == Level::hanging; }

/// The one that hangs must be this one, in this callback, and the only one.
void check_hang(Tanks& tanks, const std::string& component, const std::string& callback) {
    REQUIRE(tanks.sees(hangs));
    const State state = tanks.look();
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& tick : state.ticks)
        if (tick.hang) found.emplace_back(tick.hang->component, tick.hang->callback);
    CHECK(found == std::vector{std::pair(component, callback)});
    CHECK_THAT(judge(state).reason, Contains(component + " in ") &&
                                        Contains(": " + callback + " has not returned since ") &&
                                        Contains("its period is 10 ms"));
}

} // namespace

TEST_CASE("only the hanging component is reported, with its callback") {
    Tanks tanks;
    SECTION("an RTC, after some cycles") {
        tanks.start_rtm({"", "hang later", ""});
        check_hang(tanks, "TankRtc1", "onExecute");
    }
    SECTION("an RTC, in its first cycle") {
        tanks.start_rtm({"", "hang", ""});
        check_hang(tanks, "TankRtc1", "onExecute");
    }
    SECTION("an OPRoS component, after some cycles") {
        tanks.start_opros({"", "hang later", ""});
        check_hang(tanks, "Tank1", "onExecute");
    }
    SECTION("an OPRoS component, in its first cycle") {
        tanks.start_opros({"", "hang", ""});
        check_hang(tanks, "Tank1", "onExecute");
    }
    SECTION("several OPRoS components in one thread: the one that blocks the others") {
        tanks.start_opros({"", "hang later", ""}, {}, "periodic-shared");
        check_hang(tanks, "Tank1", "onExecute");
    }
}

TEST_CASE("an inactive component is not reported as hanging") {
    Tanks tanks;
    tanks.start_rtm({"", "deactivates itself"});
    REQUIRE(tanks.sees([&](const State& state) { return tanks.ticking(state) == 1; }));
    std::this_thread::sleep_for(1500ms); // longer than a tick may be late
    CHECK_FALSE(hangs(tanks.look()));
    CHECK_FALSE(hangs(tanks.look()));
}

TEST_CASE("a component in lock-step is not reported as hanging while no cycle is requested") {
    Tanks tanks;
    SECTION("rtm_host") { tanks.start_rtm({"", ""}, {"--lockstep", tanks.socket()}); }
    SECTION("opros_host") { tanks.start_opros({"", ""}, {"--lockstep", tanks.socket()}); }
    REQUIRE(tanks.sees([&](const State&) { return fs::exists(tanks.socket()); }));
    std::this_thread::sleep_for(1500ms);
    CHECK_FALSE(hangs(tanks.look()));
    CHECK_FALSE(hangs(tanks.look()));
}
