// SPDX-License-Identifier: Apache-2.0
// An InterceptorComp that was built against OpenRTM-aist's public API alone.
#include "two_hosts.hpp"

#include "host/process/run_command.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>

namespace {

/// The plugins of these tests before the usual ones.
void use_public_api(TwoHosts& hosts) { hosts.set_switches({"--plugin-path", PUBLIC_RTM_API}); }

bool maps_public_api(const TwoHosts& hosts) {
    std::ifstream maps("/proc/" + std::to_string(hosts.pid("rtm")) + "/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find(PUBLIC_RTM_API "/InterceptorComp.so") != std::string::npos;
}

} // namespace

TEST_CASE("with the public API alone, data and calls cross, and a killed RTM host is bound again") {
    TwoHosts hosts;
    use_public_api(hosts);
    hosts.start_rtm();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time"));
    CHECK(maps_public_api(hosts));
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.says(
        "opros", "refused: service 'dictionary.pages': operation 'pages': IDL:TestDictionary/NotFound:1.0"));
    for (int round = 1; round <= 2; ++round) {
        const auto before = hosts.restart_rtm("opros");
        CHECK(hosts.says("opros", "reply:", before));
        CHECK(hosts.says("opros", "pages: 2 last 5", before));
    }
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("with the public API alone, a killed OPRoS host is bound again") {
    TwoHosts hosts;
    use_public_api(hosts);
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("opros", "reply: hello 5 at a time"));
    hosts.kill("opros");
    const auto before = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.says("opros", "reply: hello 5 at a time", before));
    CHECK(hosts.says("opros", "pages: 2 last 5", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE(
    "with the public API alone, an OPRoS component is an RTC to which RTM tools connect and send data") {
    TwoHosts hosts;
    const std::string manager = unused_port();
    use_public_api(hosts);
    hosts.leave_out_talker_and_rtc();
    hosts.set_manager_port(manager);
    hosts.add_component("Motor", "MotorComp");
    hosts.add_component("Pump", "MotorComp", TwoHosts::property("gain", "10"));
    hosts.set_adaptor_properties(TwoHosts::property("share", "Motor, Pump"));
    hosts.start_rtm();
    hosts.start_opros();
    REQUIRE(hosts.says("rtm", "OPRoS component Motor is shown as an RTC"));
    REQUIRE(hosts.says("rtm", "OPRoS component Pump is shown as an RTC"));
    const auto succeeds = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {TANDEM_PROGRAM, "rtm"});
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + manager});
        for (int i = 0; i < 100; ++i) { // until the components are ACTIVE
            if (tandem::process::run_command(arguments).succeeded()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    };
    CHECK(succeeds({"connect", "Motor:torque", "Pump:speed"}));
    CHECK(succeeds({"inject", "Motor:speed", "3"}));
    CHECK(hosts.says("opros", "Motor torque 6.0"));
    CHECK(hosts.says("opros", "Pump torque 60.0"));
    CHECK(succeeds({"deactivate", "Motor"}));
    CHECK(hosts.says("opros", "Motor stopped"));
    CHECK(succeeds({"activate", "Motor"}));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}
