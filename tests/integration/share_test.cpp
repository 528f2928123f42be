// SPDX-License-Identifier: Apache-2.0
// OPRoS components shown as RTCs, and used by the tools of RTM.
#include "tests/apps/tandem/monitor/running_monitor.hpp"
#include "tests/apps/tandem/program.hpp"
#include "two_hosts.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

using tandem::test::Result;

namespace {

/// Two hosts, and `tandem rtm` for the RTM host. The OPRoS host shares its components.
struct Shared : TwoHosts {
    explicit Shared(const std::string& names = "Motor") : port(unused_port()) {
        leave_out_talker_and_rtc();
        set_manager_port(port);
        set_adaptor_properties(property("share", names));
    }
    Result run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "rtm");
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port});
        return tandem::test::tandem_program(arguments);
    }
    bool good(const std::vector<std::string>& arguments, const std::string& expected = "") const {
        const Result result = run(arguments);
        UNSCOPED_INFO(result.output << result.errors);
        return result.exit_code == 0 && result.output_contains(expected);
    }
    /// Returns whether `tandem rtm list` soon shows the component in that state; "": not at all.
    bool shows(const std::string& component, const std::string& state) const {
        std::string last;
        for (int i = 0; i < 1500; ++i) {
            last = "";
            for (const auto& entry : run({"list", "--json"}).json())
                if (entry["instance"] == component) last = entry["state"];
            if (last == state) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        UNSCOPED_INFO(component << " is " << last);
        return false;
    }
    void start() {
        start_rtm();
        start_opros();
    }
    /// Kills opros_host, waits until the component's RTC shows it, and starts it again. Where its new output begins.
    std::size_t restart_opros(const std::string& component) {
        kill("opros");
        CHECK(shows(component, "ERROR"));
        const auto before = output("opros").size();
        start_opros();
        return before;
    }
    std::string port;
};

/// Two shared OPRoS components of one type, started; both are seen as ACTIVE RTCs.
struct MotorAndPump : Shared {
    explicit MotorAndPump(const std::string& pump_properties = "") : Shared("Motor, Pump") {
        add_component("Motor", "MotorComp");
        add_component("Pump", "MotorComp", pump_properties);
        start();
        REQUIRE(shows("Motor", "ACTIVE"));
        REQUIRE(shows("Pump", "ACTIVE"));
    }
};

} // namespace

TEST_CASE("a shared OPRoS component is an RTC with ports, parameters and state") {
    Shared hosts;
    hosts.add_component("Motor", "MotorComp");
    hosts.start();
    REQUIRE(hosts.shows("Motor", "ACTIVE")); // its own host has started it
    const auto tree = hosts.run({"tree"}).output;
    CHECK_THAT(tree, Catch::Contains("Motor.speed DataInPort IDL:RTC/TimedDouble:1.0") &&
                         Catch::Contains("Motor.torque DataOutPort IDL:RTC/TimedDouble:1.0") &&
                         Catch::Contains("Motor.angles DataOutPort IDL:RTC/TimedDoubleSeq:1.0") &&
                         !Catch::Contains("Motor.count"));
    CHECK(hosts.says(
        "rtm",
        "Motor: port 'count' is not shown: no data type of RTM that this host knows has the members of "
        "OPRoS type long, 'x', after a time; load an RTC whose IDL has such a structure"));
    CHECK(hosts.good({"info", "Motor"}, "MotorComp"));
    CHECK(hosts.good({"conf", "Motor"}, "gain=2"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.shows("Motor", "ERROR")); // until that host comes back
    CHECK(hosts.stop("rtm") == 0);
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("RTM tools activate, deactivate, configure and send data to a shared OPRoS component") {
    Shared hosts;
    hosts.add_component("Motor", "MotorComp");
    hosts.start();
    REQUIRE(hosts.shows("Motor", "ACTIVE"));
    CHECK(hosts.good({"inject", "Motor:speed", "3"}));
    CHECK(hosts.says("opros", "Motor torque 6.000000"));

    CHECK(hosts.good({"conf", "Motor", "gain=5"}, "gain=5"));
    CHECK(hosts.says("opros", "property 'gain' of Motor is set to '5' by the RTM side"));
    CHECK(hosts.good({"inject", "Motor:speed", "3"}));
    CHECK(hosts.says("opros", "Motor torque 15.000000"));

    CHECK_FALSE(hosts.good({"conf", "Motor", "gian=5"}));
    CHECK(hosts.output("opros").find("gian") == std::string::npos);

    CHECK(hosts.good({"deactivate", "Motor"}, "Motor INACTIVE"));
    CHECK(hosts.says("opros", "Motor stopped"));
    CHECK(hosts.good({"activate", "Motor"}, "Motor ACTIVE"));
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.stop("opros") == 0);
}

TEST_CASE("data of shared OPRoS components go where RTM tools connect them") {
    MotorAndPump hosts(TwoHosts::property("gain", "10"));
    CHECK(hosts.good({"conf", "Pump"}, "gain=10"));
    CHECK(hosts.good({"connect", "Motor:torque", "Pump:speed"}));
    for (int round = 1; round <= 3; ++round) {
        CHECK(hosts.good({"inject", "Motor:speed", std::to_string(round)}));
        CHECK(hosts.says("opros", "Pump torque " + std::to_string(20 * round) + "."));
    }
    CHECK(hosts.good({"disconnect", "Motor:torque", "Pump:speed"}));
    const auto before = hosts.output("opros").size();
    CHECK(hosts.good({"inject", "Motor:speed", "4"}));
    CHECK(hosts.says("opros", "Motor torque 8."));
    CHECK(hosts.output("opros").find("Pump torque 80", before) == std::string::npos);
    CHECK(hosts.stop_both());
}

TEST_CASE("a failure in a shared OPRoS component is an error of its RTC, and the reverse") {
    MotorAndPump hosts;
    const auto fails = [&](const std::string& callback) {
        return hosts.good({"conf", "Motor", "fails=" + callback});
    };
    SECTION("onExecute throws") {
        CHECK(fails("execute"));
        CHECK(hosts.shows("Motor", "ERROR"));
        CHECK(hosts.says("opros", "Motor in error"));
        CHECK_FALSE(hosts.good({"activate", "Motor"}));
    }
    SECTION("onStart fails") {
        CHECK(hosts.good({"deactivate", "Motor"}, "Motor INACTIVE"));
        CHECK(fails("start"));
        CHECK_FALSE(hosts.good({"activate", "Motor"}));
        CHECK(
            hosts.says("rtm", "Motor: cannot activate the OPRoS component: component Motor: onStart failed"));
        CHECK(hosts.shows("Motor", "ERROR"));
        CHECK(hosts.says("opros", "Motor in error"));
    }
    SECTION("onStop fails") {
        CHECK(fails("stop"));
        hosts.run({"deactivate", "Motor"}); // RTM knows no deactivation that fails
        CHECK(hosts.shows("Motor", "ERROR"));
        CHECK(hosts.says("opros", "Motor in error"));
    }
    CHECK(hosts.shows("Pump", "ACTIVE"));
    CHECK(fails("no"));
    // Its property is set before the next start, so the first recovery decides on the old one, which does not fail.
    CHECK(hosts.good({"reset", "Motor"}, "Motor INACTIVE"));
    CHECK(hosts.says("opros", "Motor recovered"));
    CHECK(hosts.good({"activate", "Motor"}, "Motor ACTIVE"));
    CHECK(hosts.stop_both());
}

TEST_CASE("a killed OPRoS host shows in its RTCs, and is followed when it returns") {
    MotorAndPump hosts;
    CHECK(hosts.good({"deactivate", "Pump"}));
    CHECK(hosts.good({"conf", "Motor", "gain=5"}));
    CHECK(hosts.good({"connect", "Motor:torque", "Pump:speed"}));
    hosts.kill("opros");
    CHECK(hosts.shows("Motor", "ERROR"));
    CHECK(hosts.shows("Pump", "ERROR"));
    CHECK_FALSE(hosts.good({"reset", "Motor"}));
    CHECK(hosts.says("rtm", "Motor: cannot reset the OPRoS component: the OPRoS host is not running"));
    const auto before = hosts.output("opros").size();
    hosts.start_opros();
    CHECK(hosts.shows("Motor", "ACTIVE"));
    CHECK(hosts.shows("Pump", "ACTIVE")); // as its own host has it
    CHECK(hosts.good({"inject", "Motor:speed", "3"}));
    CHECK(hosts.says("opros", "Motor torque 15.", before)); // the RTC's configuration holds
    CHECK(hosts.says("opros", "Pump torque 30.", before));  // and so does its connection
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.stop("opros") == 0);
}

TEST_CASE("an OPRoS host replaced by one with other components shows the new components") {
    Shared hosts("Motor");
    hosts.add_component("Motor", "MotorComp");
    hosts.add_component("Pump", "MotorComp");
    hosts.start();
    REQUIRE(hosts.shows("Motor", "ACTIVE"));
    for (const char* now : {"Pump", "Motor"}) {
        const std::string before = now == std::string("Pump") ? "Motor" : "Pump";
        hosts.kill("opros");
        CHECK(hosts.shows(before, "ERROR"));
        const auto begin = hosts.output("rtm").size();
        hosts.set_adaptor_properties(TwoHosts::property("share", now));
        hosts.start_opros();
        CHECK(hosts.shows(now, "ACTIVE"));
        CHECK(hosts.shows(before, ""));
        CHECK(hosts.says("rtm", "OPRoS component " + before + " is no longer shared with the same ports",
                         begin));
        CHECK(hosts.good({"inject", now + std::string(":speed"), "3"}));
        CHECK(hosts.says("opros", now + std::string(" torque 6.")));
    }
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("an RTC that exits destroys only its OPRoS component") {
    MotorAndPump hosts;
    CHECK(hosts.good({"exit", "Motor"}));
    CHECK(hosts.says("opros", "Motor destroyed"));
    CHECK(hosts.shows("Motor", ""));
    CHECK(hosts.shows("Pump", "ACTIVE"));
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.output("opros").find("Pump stopped") == std::string::npos);
    hosts.start_rtm(); // another one
    CHECK(hosts.shows("Pump", "ACTIVE"));
    CHECK(hosts.shows("Motor", ""));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("a component started through its RTC stops when the RTM host is gone, and others continue") {
    Shared hosts("Motor, Pump, Nobody");
    hosts.add_component("Motor", "MotorComp");
    hosts.add_component("Pump", "MotorComp");
    hosts.start();
    CHECK(hosts.says("opros",
                     "Adaptor: property 'share' names 'Nobody', which is not another component of the "
                     "application; it has Motor, Pump, Adaptor"));
    REQUIRE(hosts.shows("Motor", "ACTIVE"));
    CHECK(hosts.good({"deactivate", "Motor"}));
    CHECK(hosts.good({"activate", "Motor"}));
    const auto before = hosts.output("opros").size();
    hosts.kill("rtm");
    CHECK(hosts.says("opros", "Motor stopped", before));
    CHECK(hosts.output("opros").find("Pump stopped", before) == std::string::npos);
    CHECK(hosts.stop("opros") == 0);
}

TEST_CASE("an RTC calls the service of a shared OPRoS component") {
    Shared hosts("Shelf");
    hosts.set_rtc("ClerkRtc");
    hosts.set_interceptor("manage=no"); // it is not behind the link
    hosts.add_component("Shelf", "ShelfComp");
    hosts.set_adaptor_properties(
        TwoHosts::property("share", "Shelf") +
        TwoHosts::property("interfaces", "Shelf.dictionary=TestDictionary::Dictionary"));
    hosts.start();
    REQUIRE(hosts.shows("Shelf", "ACTIVE"));
    CHECK_THAT(hosts.run({"info", "Shelf"}).output, Catch::Contains("TestDictionary::Dictionary"));
    CHECK(hosts.good({"connect", "ClerkRtc0:books", "Shelf:dictionary"}));
    CHECK(hosts.good({"activate", "ClerkRtc0"}));
    CHECK(hosts.says("rtm", "clerk: 2 pages, the last is 5"));
    CHECK(hosts.says("rtm", "clerk: UNKNOWN"));
    CHECK(hosts.says("rtm", "service 'Shelf.dictionary.pages': there is no such word"));
    CHECK(hosts.stop("opros") == 0);
    CHECK(hosts.stop("rtm") == 0);
}

TEST_CASE("events of a shared OPRoS component are data ports of a structure of id and content") {
    Shared hosts("Siren");
    hosts.set_rtc("AlarmRtc");
    hosts.set_interceptor("manage=no"); // it is not behind the link
    hosts.add_component("Siren", "AlarmComp");
    hosts.start();
    REQUIRE(hosts.shows("Siren", "ACTIVE"));
    CHECK_THAT(hosts.run({"tree"}).output,
               Catch::Contains("Siren.alarm DataOutPort IDL:TestAlarm/TimedAlarm:1.0") &&
                   Catch::Contains("Siren.notice DataInPort IDL:TestAlarm/TimedAlarm:1.0"));
    CHECK(hosts.says("rtm",
                     "Siren: port 'number' is not shown: no data type of RTM that this host knows has the "
                     "members of OPRoS type event with content int, 'si', after a time"));
    CHECK(hosts.good({"connect", "Siren:alarm", "AlarmRtc0:raised"}));
    CHECK(hosts.good({"connect", "AlarmRtc0:answer", "Siren:notice"}));
    CHECK(hosts.good({"activate", "AlarmRtc0"}));
    CHECK(hosts.says("opros", "event: answer to hot "));
    CHECK(hosts.says("opros", " at a time, "));
    const auto before = hosts.restart_opros("Siren");
    CHECK(hosts.says("opros", "event: answer to hot ", before));
    CHECK(hosts.stop_both());
    CHECK_FALSE(hosts.left_in_shared_memory());
}

TEST_CASE("a port of a type that RTM does not know is shown under a type of its members if a property asks "
          "for it") {
    Shared hosts("Siren");
    hosts.set_rtc("AlarmRtc");
    hosts.set_interceptor("manage=no"); // it is not behind the link
    hosts.add_component("Siren", "AlarmComp");
    hosts.set_adaptor_property("interfaces", "Siren.number=OPRoS::message, Siren.alarm=OPRoS::message");
    hosts.start();
    REQUIRE(hosts.shows("Siren", "ACTIVE"));
    CHECK_THAT(hosts.run({"tree"}).output,
               Catch::Contains("IDL:OPRoS/si:1.0") &&
                   Catch::Contains("Siren.notice DataInPort IDL:TestAlarm/TimedAlarm:1.0") &&
                   !Catch::Contains("Siren.alarm DataOutPort IDL:TestAlarm/TimedAlarm:1.0"));
    CHECK(hosts.stop_both());
}

TEST_CASE("an RTC provides a service that a shared OPRoS component requires") {
    Shared hosts("Reader");
    hosts.set_rtc("EchoRtc");
    hosts.set_interceptor("manage=no"); // it is not behind the link
    hosts.add_component("Reader", "TalkerComp");
    hosts.set_adaptor_property("interfaces", "Reader.dictionary=TestDictionary::Dictionary.dictionary");
    hosts.start();
    REQUIRE(hosts.shows("Reader", "ACTIVE"));
    CHECK_THAT(hosts.run({"info", "Reader"}).output, Catch::Contains("TestDictionary::Dictionary"));
    CHECK(hosts.good({"activate", "EchoRtc0"}));
    CHECK(hosts.good({"connect", "Reader:word", "EchoRtc0:word"}));
    CHECK(hosts.good({"connect", "EchoRtc0:reply", "Reader:reply"}));
    CHECK(hosts.says("opros", "refused: service 'Reader.dictionary.pages': not ready"));
    CHECK(hosts.good({"connect", "Reader:dictionary", "EchoRtc0:dictionary"}));
    CHECK(hosts.says("opros", "pages: 2 last 5"));
    CHECK(hosts.says("opros", "NotFound")); // the RTC's exception
    const auto before = hosts.restart_opros("Reader");
    CHECK(hosts.says("opros", "pages: 2 last 5", before));
    CHECK(hosts.stop_both());
}

TEST_CASE("a required service connected by the application is not shared") {
    Shared hosts("Reader, Shelf");
    hosts.add_component("Reader", "TalkerComp");
    hosts.add_component("Shelf", "ShelfComp");
    hosts.set_connections(TwoHosts::connection("service", "Reader", "dictionary", "Shelf", "dictionary") +
                          TwoHosts::connection("data", "Reader", "word", "Reader", "reply"));
    hosts.start();
    CHECK(hosts.says("opros", "port 'Reader.dictionary' is not shared: the application connects it"));
    CHECK(hosts.says("opros",
                     "pages: 2 last 5")); // from Shelf, whose next answer is a user-defined exception
}

TEST_CASE("a client of Foxglove's protocol publishes to a shared OPRoS component and sets its properties") {
    Shared hosts;
    hosts.add_component("Motor", "MotorComp");
    hosts.start();
    REQUIRE(hosts.shows("Motor", "ACTIVE"));
    const tandem::monitor::test::RunningMonitor monitor(hosts.link(), "--control");
    tandem::monitor::test::Live client(monitor, 0, "/?token=" + monitor.token, "foxglove.websocket.v1");
    const std::string prefix = "/" + hosts.link() + "/";
    const auto has = [&](const nlohmann::json& message) {
        for (const auto& channel : message.value("channels", nlohmann::json::array()))
            if (channel["topic"] == prefix + "Motor.speed") return true;
        return false;
    };
    for (auto message = client.next(); !has(message); message = client.next()) INFO(message.dump());
    const nlohmann::json channels{
        {{"id", 1}, {"topic", prefix + "Motor.speed"}, {"encoding", "json"}, {"schemaName", ""}},
        {{"id", 2}, {"topic", prefix + "Motor.torque"}, {"encoding", "json"}, {"schemaName", ""}}};
    client.send(nlohmann::json{{"op", "advertise"}, {"channels", channels}}.dump());
    const auto status = [&] {
        for (auto message = client.next();; message = client.next())
            if (message["op"] == "status") return message["message"].get<std::string>();
    };
    CHECK_THAT(status(), Catch::Contains("torque") && Catch::Contains("shown as an RTC"));
    const std::string head("\x01\x01\0\0\0", 5); // a message on channel 1
    client.send_binary(head + "[3]");
    CHECK(hosts.says("opros", "Motor torque 6.000000"));
    client.send(nlohmann::json{{"op", "setParameters"},
                               {"parameters", {{{"name", prefix + "Motor/gain"}, {"value", 5}}}}}
                    .dump());
    CHECK(hosts.says("opros", "property 'gain' of Motor is set to '5' by the RTM side"));
    // The component has it from its next cycle on; the one under way may take the first of these messages.
    for (int i = 0; i < 3; ++i) {
        client.send_binary(head + "[3]");
        std::this_thread::sleep_for(std::chrono::milliseconds(100)); // a cycle takes 10
    }
    CHECK(hosts.says("opros", "Motor torque 15.000000"));
    CHECK(hosts.stop("rtm") == 0);
    CHECK(hosts.stop("opros") == 0);
}
