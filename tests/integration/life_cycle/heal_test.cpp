// SPDX-License-Identifier: Apache-2.0
// A link after an RTC behind it was in ERROR.
#include "tests/apps/tandem/program.hpp"
#include "tests/integration/two_hosts.hpp"

#include <catch2/catch.hpp>

namespace {

/// ServoRtc0, whose output Motor prints.
class ServoHosts : public TwoHosts {
  public:
    ServoHosts() : port_(unused_port()) {
        leave_out_talker_and_rtc();
        set_rtc("ServoRtc");
        add_component("Motor", "MotorComp");
        set_connections(connection("data", "Adaptor", "out", "Motor", "speed"));
        set_manager_port(port_);
        start_rtm();
        start_opros();
        REQUIRE(says("opros", "Motor torque 2."));
    }
    tandem::test::Result rtm(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port_});
        return tandem::test::tandem_program(arguments);
    }
    void fail_rtc() {
        const auto before = output("opros").size();
        REQUIRE(rtm({"conf", "ServoRtc0", "fails=1"}).exit_code == 0);
        REQUIRE(says("opros", "Adaptor: RTC 'ServoRtc0' went to ERROR", before));
    }
    /// Returns whether new values of the RTC reach Motor from now on.
    bool carries_data() const { return says("opros", "Motor torque 2.", output("opros").size()); }

  private:
    const std::string port_;
};

} // namespace

TEST_CASE("a link works after its RTC was reset and activated, even after the next restart of the RTM host") {
    ServoHosts hosts;
    hosts.fail_rtc();
    const auto before = hosts.output("opros").size();
    CHECK(hosts.rtm({"reset", "ServoRtc0"}).exit_code == 0);
    CHECK(hosts.rtm({"activate", "ServoRtc0"}).exit_code == 0);
    CHECK(hosts.says("opros", "ServoRtc0 can be active again; Adaptor leaves ERROR", before));
    CHECK(hosts.carries_data());
    for (int round = 0; round < 2; ++round) {
        hosts.restart_rtm("opros");
        CHECK(hosts.carries_data());
    }
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a link whose RTC is in ERROR works after a restart of the RTM host") {
    ServoHosts hosts;
    hosts.fail_rtc();
    const auto before = hosts.restart_rtm("opros");
    CHECK(hosts.says("opros", "ServoRtc0 can be active again; Adaptor leaves ERROR", before));
    CHECK(hosts.carries_data());
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC that a tool deactivates while the link needs it is named") {
    ServoHosts hosts;
    CHECK(hosts.rtm({"deactivate", "ServoRtc0"}).exit_code == 0);
    CHECK(hosts.says("rtm", "RTC ServoRtc0 was deactivated, but not by the link"));
    CHECK(hosts.stop_both());
}
