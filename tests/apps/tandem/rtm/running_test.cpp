// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm` for components that run, on a host in another process.
#include "tests/apps/tandem/rtm/running_manager.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

using tandem::test::Result;
using tandem::test::tandem_program;
using Running = tandem::test::RunningManager;

TEST_CASE("tandem rtm shows components and changes their states and parameters") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const auto list = host.good({"list", "--json"}).json();
    REQUIRE(list.size() == 3);
    CHECK(list[0]["instance"] == "Counter0");
    CHECK(list[0]["address"] == host.at + "Counter0");
    CHECK(list[0]["state"] == "INACTIVE");
    CHECK(host.good({"info", host.at + "Counter0", "--json"}).json()["ports"][0]["name"] == "Counter0.out");
    CHECK(host.good({"tree"}).output_contains("Reporter0.in DataInPort IDL:RTC/TimedLong:1.0"));

    CHECK(host.good({"activate", "Counter0", "Reporter0"}).output_contains("Reporter0 ACTIVE"));
    CHECK(host.good({"deactivate", "Counter0"}).output_contains("Counter0 INACTIVE"));
    CHECK_THAT(host.failed({"activate", "Thrower0"}),
               Catch::Contains("ERROR") && Catch::Contains("rtm reset"));
    CHECK(host.good({"reset", "Thrower0"}).output_contains("INACTIVE"));

    CHECK(host.good({"conf", "Counter0", "step=5"}).output_contains("step=5"));
    CHECK_THAT(host.failed({"conf", "Counter0", "stride=5"}), Catch::Contains("it has: step"));
    CHECK_THAT(host.failed({"conf", "Counter0", "stpe=5"}),
               Catch::Contains(
                   "configuration set default has no parameter stpe; did you mean step? (it has: step)"));
    CHECK_THAT(host.failed({"conf", "Counter0", "step=abc"}),
               Catch::Contains("Counter0: step is abc, expected a whole number (int)"));
    CHECK(host.good({"conf", "Counter0"}).output_contains("step=5"));
    CHECK(host.good({"exit", "Thrower0"}).output_contains("exited"));
    CHECK_THAT(host.failed({"info", "Thrower0"}), Catch::Contains("component Thrower0 not found"));
}

TEST_CASE("tandem rtm waits for slow transitions, and distinguishes hanging, failing and refused ones") {
    Running host("SlowDevice?in=activated&ms=1500, SlowDevice?in=activated&ms=700&fails=YES, "
                 "SlowDevice?in=activated&ms=1000000, SlowDevice?in=deactivated&ms=1500, "
                 "SlowDevice?in=reset&ms=1500&breaks=YES, SlowDevice?in=reset&ms=0&breaks=YES&fails=YES, "
                 "SlowDevice?in=activated&ms=2500");
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    CHECK(host.good({"activate", "SlowDevice0"}).output == "SlowDevice0 ACTIVE\n");
    CHECK_THAT(host.failed({"activate", "SlowDevice1"}),
               Catch::Contains("SlowDevice1 is in ERROR after ") &&
                   Catch::Contains(" s: its onActivated or onExecute has failed; see its log, then tandem "
                                   "rtm reset SlowDevice1"));
    CHECK_THAT(host.failed({"activate", "SlowDevice1"}),
               Catch::Contains("SlowDevice1 is ERROR and refuses to be activated: "));
    CHECK_THAT(host.failed({"activate", "SlowDevice2", "--timeout", "1"}),
               Catch::Contains("SlowDevice2 is still activating after ") &&
                   Catch::Contains(" s: onActivated has taken ") && Catch::Contains(" otherwise it hangs"));
    // Its state is INACTIVE, but it will be ACTIVE when the callback returns.
    CHECK_THAT(host.failed({"deactivate", "SlowDevice2", "--timeout", "0.2"}),
               Catch::Contains("SlowDevice2 cannot be deactivated yet: its onActivated has taken ") &&
                   Catch::Contains(" s so far; allow more time with --timeout"));
    CHECK(host.good({"list"}).output_contains("INACTIVE (onActivated has taken "));
    CHECK(host.good({"info", "SlowDevice2"}).output_contains(", INACTIVE; onActivated has taken "));
    CHECK(host.failed({"activate", "SlowDevice6", "--timeout", "0.5"}).find("still activating") !=
          std::string::npos);
    CHECK(host.good({"deactivate", "SlowDevice6", "--timeout", "60"}).output == "SlowDevice6 INACTIVE\n");
    CHECK_FALSE(host.good({"info", "SlowDevice6"}).output_contains("onActivated"));
    host.good({"activate", "SlowDevice3"});
    CHECK(host.good({"deactivate", "SlowDevice3"}).output == "SlowDevice3 INACTIVE\n");
    for (const char* name : {"SlowDevice4", "SlowDevice5"}) {
        host.run({"activate", name}); // it breaks at once
        REQUIRE(testing::eventually([&] { return host.run({"info", name}).output_contains("ERROR"); }));
    }
    CHECK(host.good({"reset", "SlowDevice4"}).output == "SlowDevice4 INACTIVE\n");
    CHECK_THAT(host.failed({"reset", "SlowDevice5"}), Catch::Contains("its onReset has failed"));
}

TEST_CASE(
    "tandem rtm waits for a component that is still being created, and not for one that does not exist") {
    Running host("Counter");
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    int argc = 0;
    CORBA::ORB_var orb = CORBA::ORB_init(argc, nullptr, "omniORB4");
    RTM::Manager_var manager = host.other.manager(orb.in());
    // The request of each lasts as long as its onInitialize.
    auto create = [&](const char* arguments) {
        return std::thread([&manager, arguments] {
            try {
                RTC::RTObject_var made = manager->create_component(arguments);
            } catch (const CORBA::SystemException&) {
                // the host has ended
            }
        });
    };
    auto hanging = create("SlowDevice?in=initialize&ms=1000000&instance_name=hangs");
    REQUIRE(testing::eventually([&] { return host.run({"list"}).output_contains("hangs"); }));
    CHECK(host.good({"list"}).output_contains("CREATED (onInitialize has taken "));
    CHECK(host.good({"tree"}).output_contains("hangs CREATED (onInitialize has taken "));
    const auto list = host.good({"list", "--json"}).json();
    REQUIRE(list.size() == 2);
    CHECK(list[1]["instance"] == "hangs");
    CHECK(list[1]["type"] == "SlowDevice");
    CHECK(list[1]["state"] == "CREATED");
    CHECK(list[1]["address"] == host.at + "hangs");
    for (const std::string& name : {std::string("hangs"), host.at + "hangs"})
        CHECK_THAT(host.failed({"info", name, "--timeout", "0.3"}),
                   Catch::Contains(host.at + "hangs is still being created: onInitialize has taken ") &&
                       Catch::Contains(" s so far; allow more time with --timeout"));
    CHECK_THAT(host.failed({"info", "other", "--timeout", "0.3"}), Catch::Contains("no such component"));

    auto slow = create("SlowDevice?in=initialize&ms=2500&instance_name=slow");
    REQUIRE(testing::eventually([&] { return host.run({"list"}).output_contains("slow"); }));
    CHECK(host.good({"activate", "slow", "--timeout", "60"}).output == "slow ACTIVE\n");
    CHECK(host.other.host.wait_for_error("onInitialize of slow has taken 2 s so far\n"));
    CHECK(host.other.host.wait_for_error("onInitialize of slow has returned within "));
    slow.join();
    auto failing = create("SlowDevice?in=initialize&ms=1000&fails=YES&instance_name=fails");
    REQUIRE(testing::eventually([&] { return host.run({"list"}).output_contains("fails"); }));
    CHECK_THAT(host.failed({"info", "fails", "--timeout", "60"}),
               Catch::Contains("its creation failed: see its host's log"));
    failing.join();
    host.other.host.send_signal(SIGKILL);
    hanging.join();
    orb->destroy();
}

TEST_CASE("a host ends normally while a tool waits for a transition") {
    Running host("Counter", {"exec_cxt.periodic.rate:0.01", "exec_cxt.activation_timeout:1000"});
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    std::thread tool([&] { host.run({"activate", "Counter0", "--timeout", "60"}); });
    // The request has usually arrived by then. If not, the host ends cleanly anyway.
    std::this_thread::sleep_for(std::chrono::seconds(2));
    host.other.host.send_signal(SIGTERM);
    CHECK(host.other.host.wait_for_exit() == 0);
    CHECK_THAT(host.other.host.errors, !Catch::Contains("does not return"));
    tool.join();
}

TEST_CASE("each value that tandem rtm inject sends is read, however few and however fast") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    CHECK_THAT(host.failed({"inject", "Reporter0:in", "7"}),
               Catch::Contains(
                   "1 of 1 values sent to Reporter0.in were delivered, 1 of these were not read within ") &&
                   Catch::Contains("Reporter0 is INACTIVE; run tandem rtm activate Reporter0"));
    host.good({"activate", "Reporter0"});
    for (int i = 0; i < 9; ++i)
        CHECK(host.good({"inject", "Reporter0:in", "7"}).output == "Reporter0.in: 1 value sent and read\n");
    CHECK_FALSE(host.other.host.wait_for_output("received", std::chrono::seconds(0)));
    CHECK(host.good({"inject", "Reporter0:in", "7", "-p", "subscription_type=new"}).output_contains("read"));
    CHECK(host.other.host.wait_for_output("received 10\n"));
    // Many more than the buffer of an InPort holds.
    CHECK(host.good({"inject", "Reporter0:in", "7", "-n", "50", "--json"}).json()["read"] == true);
}

TEST_CASE("tandem rtm connects ports and prints and injects their values") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    host.good({"activate", "Counter0", "Reporter0"});
    CHECK_THAT(host.failed({"connect", "Thrower0:out", "Reporter0:in"}),
               Catch::Contains("Thrower0 has no port out (it has: none)"));
    // The port itself says why it refuses.
    CHECK_THAT(
        host.failed({"connect", "Counter0:out", "Reporter0:in", "-p", "interface_type=telepathy"}),
        Catch::Contains("Counter0.out and Reporter0.in cannot be connected: Counter0.out: interface_type is "
                        "telepathy, expected corba_cdr, "));
    CHECK_THAT(host.run({"connect", "Counter0:out", "Reporter0:in", "-p", "dataflow_typ=push", "-p",
                         "interface_type=telepathy"})
                   .errors,
               Catch::Contains("tandem: warning: unknown key dataflow_typ; did you mean dataflow_type?"));
    const auto connection = host.good({"connect", "Counter0:out", "Reporter0.in", "--json"}).json();
    CHECK(connection[0]["ports"][1] == "Reporter0.in");
    CHECK(host.other.host.wait_for_output("received 1"));
    CHECK_THAT(host.failed({"connect", "Counter0:out", "Reporter0:in"}),
               Catch::Contains("already connected"));
    CHECK_THAT(host.failed({"connect", "Reporter0:in", "Reporter0:in"}),
               Catch::Contains("cannot be connected"));
    CHECK_THAT(host.failed({"connect", "Counter0:in", "Reporter0:in"}),
               Catch::Contains("it has: Counter0.out"));
    const auto cat = host.good({"cat", "Counter0:out", "-n", "2", "--for", "20"});
    const auto second = nlohmann::json::parse(cat.output.substr(cat.output.find('\n')));
    CHECK(second["data"].get<long>() > 1);
    CHECK(second["tm"]["sec"].get<long>() > 0);
    CHECK(
        host.good({"cat", "Counter0:out", "-n", "1", "--for", "20", "--raw"}).output_contains("{\"cdr\":\""));
    host.good({"disconnect", "Counter0:out"});
    CHECK_THAT(host.failed({"disconnect", "Counter0:out"}), Catch::Contains("no such connection"));
    const auto sent =
        host.good({"inject", "Reporter0:in", "7", "{\"tm\":{\"sec\":1},\"data\":-8}", "-n", "3", "--json"});
    CHECK(sent.json()["sent"] == 6);
    CHECK_THAT(host.failed({"inject", "Reporter0:in", "hello"}), Catch::Contains("TimedLong.data"));
    CHECK_THAT(host.failed({"inject", "Reporter0:in", "5000000000"}), Catch::Contains("does not fit"));
    CHECK_THAT(host.failed({"inject", "Counter0:out", "7"}), Catch::Contains("expected a DataInPort"));
    CHECK_THAT(host.failed({"cat", "Reporter0:in"}), Catch::Contains("expected a DataOutPort"));
}

TEST_CASE("no sub-command of tandem rtm makes calls that crash a manager of OpenRTM-aist") {
    const std::string port = testing::unused_port();
    testing::RemoteHost other("FragileHost,Counter,Reporter", port, {"manager.corba_servant:NO"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    const std::string at = "rtcloc://127.0.0.1:" + port + "/";
    for (std::string counter : {std::string("Counter0"), at + "Counter0", at + "*/Counter0"}) {
        const std::string reporter = counter.substr(0, counter.size() - 8) + "Reporter0";
        for (const std::vector<std::string>& command :
             std::vector<std::vector<std::string>>{{"list"},
                                                   {"tree"},
                                                   {"info", counter},
                                                   {"conf", counter, "step=2"},
                                                   {"activate", counter},
                                                   {"connect", counter + ":out", reporter + ":in"},
                                                   {"cat", counter + ":out", "-n", "1"},
                                                   {"inject", reporter + ":in", "1"},
                                                   {"disconnect", counter + ":out", reporter + ":in"},
                                                   {"deactivate", counter}}) {
            std::vector<std::string> arguments{"rtm"};
            arguments.insert(arguments.end(), command.begin(), command.end());
            arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + port});
            const Result result = tandem_program(arguments);
            INFO(command[0] << " " << counter << ": " << result.output << result.errors);
            CHECK(result.exit_code == 0);
        }
    }
}

TEST_CASE("tandem rtm inject reports that the receiver's host has ended") {
    Running host("BadPeer");
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    CHECK_THAT(host.failed({"inject", "BadPeer0:aborts", "1"}),
               Catch::Contains("BadPeer0.aborts disconnected, or its host ended, while a value was sent"));
    CHECK(host.other.host.wait_for_exit() == -SIGABRT);
}

TEST_CASE("tandem rtm cat pulls, and reports what it is waiting for") {
    Running host;
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const std::vector<std::string> cat{"cat", "Counter0:out", "-p", "dataflow_type=pull", "-n", "2", "--for"};
    auto with_time = [&](const char* seconds) {
        auto arguments = cat;
        arguments.push_back(seconds);
        return arguments;
    };
    const Result inactive = host.run(with_time("1.5"));
    CHECK(inactive.exit_code == 1);
    CHECK_THAT(inactive.errors,
               Catch::StartsWith("tandem: waiting for Counter0.out: Counter0 is INACTIVE; run tandem rtm "
                                 "activate Counter0\n"));
    host.good({"activate", "Counter0"});
    CHECK(host.good(with_time("20")).output_contains("\"data\":"));
}

TEST_CASE("tandem rtm cat names the remedy for a component in its error state") {
    Running host("FailingCounter", {"manager.components.preactivation:FailingCounter0"});
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const std::vector<std::string> cat{"cat", "FailingCounter0:out", "-n", "1", "--for", "1.5"};
    CHECK_THAT(host.run(cat).errors,
               Catch::StartsWith("tandem: waiting for FailingCounter0.out: FailingCounter0 is ERROR; run "
                                 "tandem rtm reset FailingCounter0\n"));
}

TEST_CASE("tandem rtm cat reconnects if the port silently drops its connection") {
    Running host("Dropper", {"manager.components.preactivation:Dropper0"});
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const Result result = host.good({"cat", "Dropper0:out", "-n", "1", "--for", "60"});
    CHECK_THAT(result.errors, Catch::Contains("tandem: Dropper0.out dropped the connection; reconnecting\n"));
    CHECK(result.output_contains("\"data\":"));
}

TEST_CASE("tandem rtm disconnect warns if the reader's host may crash") {
    Running host("ForeignReader,Counter,Reporter");
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    auto disconnect = [&](const std::string& reader) {
        host.good({"connect", "Counter0:out", reader});
        return host.good({"disconnect", "Counter0:out", reader}).errors;
    };
    CHECK(disconnect("ForeignReader0:in").empty()); // it is not active
    host.good({"activate", "ForeignReader0", "Reporter0"});
    CHECK(disconnect("Reporter0:in").empty());
    CHECK(
        disconnect("ForeignReader0:in") ==
        "tandem: warning: ForeignReader0 is ACTIVE in a host of OpenRTM-aist, which may crash if "
        "ForeignReader0.in is disconnected while it reads; first run tandem rtm deactivate ForeignReader0\n");
}

TEST_CASE(
    "tandem rtm conf takes effect on a component that applies values when their set is next activated") {
    testing::RemoteHost other("ConfigurationUser", testing::unused_port(),
                              {"manager.components.preactivation:ConfigurationUser0"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    auto conf = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"rtm", "conf", "ConfigurationUser0"});
        arguments.insert(arguments.end(), {"--manager", "127.0.0.1:" + other.port});
        const Result result = tandem_program(arguments);
        INFO(result.output << result.errors);
        CHECK(result.exit_code == 0);
        return result;
    };
    CHECK(other.host.wait_for_output("uses step 1\n"));
    CHECK(conf({"step=5"}).output_contains("default (active)\n  level=2\n  size=3\n  step=5\n"));
    CHECK(other.host.wait_for_output("uses step 5\n"));
    CHECK(conf({"step=6"}).output_contains("default (active)\n  level=2\n  size=3\n  step=6\n"));
    CHECK(other.host.wait_for_output("uses step 6\n"));
    // Setting values of another set does not change the active set.
    CHECK(conf({"step=8", "--set", "other"}).output_contains("other\n  step=8\n"));
    // --set limits what is shown, in JSON, too.
    CHECK(conf({"--set", "other"}).output == "other\n  step=8\n");
    CHECK(conf({"--set", "other", "--json"}).json() ==
          nlohmann::json::parse(R"([{"set": "other", "active": false, "values": {"step": "8"}}])"));
    CHECK(conf({"--json"}).json().size() == 2);
    const Result unknown = tandem_program(
        {"rtm", "conf", "ConfigurationUser0", "--set", "othr", "--manager", "127.0.0.1:" + other.port});
    CHECK(unknown.exit_code == 1);
    CHECK(unknown.errors.find("there is no configuration set othr") != std::string::npos);
    CHECK(unknown.errors.find("default, other") != std::string::npos);
    CHECK(conf({"step=9"}).output_contains("default (active)\n  level=2\n  size=3\n  step=9\n"));
    CHECK(other.host.wait_for_output("uses step 9\n"));
    CHECK(conf({"--activate", "other"}).output_contains("other (active)\n  step=8\n"));
    CHECK(other.host.wait_for_output("uses step 8\n"));
}

TEST_CASE("tandem rtm conf warns of a lost number if the host accepts any text") {
    Running host("ConfigurationUser", {"manager.components.preactivation:ConfigurationUser0"});
    REQUIRE(host.other.host.wait_for_output("ready\n"));
    const std::vector<std::string> conf = {"conf", "ConfigurationUser0"};
    auto with = [&](const std::string& assignment) {
        auto arguments = conf;
        arguments.push_back(assignment);
        return arguments;
    };
    CHECK(host.good(with("level=5")).errors.empty());
    CHECK(host.good(with("level=abc")).errors ==
          "tandem: warning: level=abc replaces 5: if level is a number, the component now uses its default, "
          "because its host does not check values\n");
    CHECK(host.good(with("level=def")).errors.empty()); // as far as can be seen, it was not a number
    CHECK(host.failed(with("size=abc")) ==
          "tandem: size=abc was not set: size has type int, so the component would use its default\n");
    CHECK(host.good(conf).output_contains("size=3"));
    CHECK(host.good(with("size=4")).output_contains("size=4"));
}
