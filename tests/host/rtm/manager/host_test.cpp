// SPDX-License-Identifier: Apache-2.0
// rtm_host as a program: rtc.conf, standard output and error, signals, exit codes.
#include "host/rt/lock_step/step_client.hpp"
#include "tests/host/rtm/host_process.hpp"
#include "tests/host/rtm/manager/conf_folder.hpp"
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <memory>

using testing::HostProcess;
using testing::is_listening;
using testing::unused_port;
using Folder = testing::ConfFolder;

namespace {

const char* const pair_conf =
    "manager.modules.preload: TestComponents.so\n"
    "manager.components.precreate: Counter, Reporter\n"
    "manager.components.preconnect: Counter0.out?port=Reporter0.in&interface_type=corba_cdr&"
    "dataflow_type=push&subscription_type=flush\n"
    "manager.components.preactivation: Counter0, Reporter0\n"
    "exec_cxt.periodic.rate: 200\n";

// The message of rtm_host for a configuration that it refuses: exactly one line, with exit code 1.
std::string refusal(const std::vector<std::string>& arguments) {
    HostProcess host(arguments);
    REQUIRE(host.wait_for_exit() == 1);
    CHECK(host.output.find("ready") == std::string::npos);
    CHECK(std::count(host.errors.begin(), host.errors.end(), '\n') == 1);
    return host.errors;
}

std::string refusal(const std::string& conf) {
    Folder folder;
    return refusal(std::vector<std::string>{"-f", folder.conf(conf)});
}

} // namespace

TEST_CASE("rtm_host runs what rtc.conf names, and a signal ends it cleanly") {
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
    Folder folder;
    HostProcess host({"-f", folder.conf(pair_conf)});
    REQUIRE(host.wait_for_output("ready\n"));
    REQUIRE(host.wait_for_output("received "));
    host.send_signal(signal);
    CHECK(host.wait_for_exit() == 0);
    CHECK(host.output.find("Reporter0 deactivated\nReporter0 finalized\n") != std::string::npos);
}

TEST_CASE("rtm_host refuses bad input with one line that says where and what") {
    using Catch::Contains;
    CHECK_THAT(refusal("manager.modules.preload TestComponents.so\n"),
               Contains("rtc.conf:2: expected `key: value`"));
    CHECK_THAT(refusal(std::vector<std::string>{"-f", "/no/such/rtc.conf"}), Contains("/no/such/rtc.conf"));
    CHECK_THAT(refusal("manager.modules.preload: Missing.so\n"),
               Contains("rtc.conf") && Contains("Missing.so"));
    CHECK_THAT(refusal("manager.modules.preload: BadModule.so\n"), Contains("BadModuleInit"));
    CHECK_THAT(refusal("manager.modules.preload: TestComponents.so(NoSuchInit)\n"), Contains("NoSuchInit"));
    CHECK_THAT(refusal("manager.modules.preload: "
                       "TestComponents.so(OnlyReporters)\nmanager.components.precreate: Counter\n"),
               Contains("Counter") && Contains("known: ") && Contains("Reporter"));
    CHECK_THAT(
        refusal(
            "manager.modules.preload: TestComponents.so\nmanager.components.precreate: Counter, Reporter\n"
            "manager.components.preconnect: Counter0.out?port=Reporter0.inn\n"),
        Contains("Reporter0 has no port inn (it has: in)"));
    CHECK_THAT(refusal("manager.modules.preload: TestComponents.so\nmanager.components.precreate: Counter\n"
                       "manager.components.preactivation: Counter1\n"),
               Contains("there is no component Counter1 (there are: Counter0)"));
    CHECK_THAT(refusal("corba.endpoints: 256.0.0.1:\n"), Contains("256.0.0.1"));
    CHECK_THAT(refusal("logger.log_level: LOUD\n"), Contains("rtc.conf:2: logger.log_level is LOUD"));
    CHECK_THAT(refusal(std::vector<std::string>{"-o", "exec_cxt.periodic.rate:-1"}),
               Contains("option -o: exec_cxt.periodic.rate is -1"));
    CHECK_THAT(refusal("manager.modules.preload: TestComponents.so\n"
                       "manager.components.precreate: RTC:Vendor:test:Counter:C++:7.5\n"),
               Contains("no component type Counter with this id: the loaded Counter has ") &&
                   Contains(" instead of 7.5") && Contains("correct the id") && !Contains("known:"));
    CHECK_THAT(refusal(std::vector<std::string>{"-p", "many"}), Contains("option -p") && Contains("many"));
}

TEST_CASE("An invalid rate prevents its component from being created") {
    using Catch::Contains;
    const std::string rate = GENERATE("5O", "0", "-5", "10Hz", "1e300");
    const std::string key = GENERATE("exec_cxt.periodic.rate", "ec.PeriodicExecutionContext.rate");
    CHECK_THAT(
        refusal("manager.modules.preload: TestComponents.so\nmanager.components.precreate: Counter?" + key +
                "=" + rate + "\n"),
        Contains("component Counter0 cannot be started: " + key + " is " + rate + ", expected a rate in Hz"));
    CHECK_THAT(refusal("manager.modules.preload: TestComponents.so\nmanager.components.precreate: Counter\n"
                       "test.Counter." +
                       key + ": " + rate + "\n"),
               Contains("component Counter0 cannot be started: " + key + " is " + rate));
}

TEST_CASE("A mistake in the settings of one component is reported in one line with what was probably meant, "
          "with and without a log") {
    const std::string log = GENERATE("", "logger.enable: NO\n", "logger.log_level: ERROR\n");
    CAPTURE(log);
    Folder folder;
    HostProcess host(
        {"-f", folder.conf(log + "manager.modules.preload: TestComponents.so\n"
                                 "manager.components.precreate: Counter, Counter?stpe=2, "
                                 "Counter?exec_cxt.periodic.rat=10, Counter?exec_ctx.periodic.rate=10, "
                                 "Counter?rate=10, Counter?execution_rate=10, Counter?ec.slow.rate=10, "
                                 "Counter?periodic.rate=10, Counter?exec_cxt.periodic.rate=\n"
                                 "exec_cxt.periodic.rte: 100\n"
                                 "port.inport.in.bufer.length: 3\n"
                                 "test.Counter0.config_file: nowhere.conf\n"
                                 "test.Counter0.port.outport.ouut.buffer.length: 4\n"
                                 "test.Counter2.conf.default.step: 3,5\n"
                                 "test.Counter0.conf.default.sted: 3\n"
                                 "test.Counter1.conf.default.step: abc\n"
                                 "test.Counter1.exec_cxt.sync_activation: perhaps\n")});
    REQUIRE(host.wait_for_output("ready\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
    for (const char* line :
         {": unknown key exec_cxt.periodic.rte; did you mean exec_cxt.periodic.rate?\n",
          ": unknown key port.inport.in.bufer.length; did you mean port.inport.in.buffer.length?\n",
          "test.Counter0.config_file: file nowhere.conf does not exist; the component keeps its defaults\n",
          "Counter0: port.outport.ouut.buffer.length: the component has no port ouut; did you mean out?\n",
          "Counter2: parameter step of configuration set default is 3,5, expected a whole number (int); "
          "the component uses the beginning, 3\n",
          "Counter0: conf.default.sted: the component has no parameter sted; did you mean step? (it has: "
          "step)\n",
          "Counter1: stpe: the component has no parameter stpe; did you mean step?\n",
          "Counter1: parameter step of configuration set default is abc, expected a whole number (int); the "
          "component "
          "uses the default, 1\n",
          "Counter1: exec_cxt.sync_activation is perhaps, expected YES or NO\n",
          "Counter2: unknown key exec_cxt.periodic.rat; did you mean exec_cxt.periodic.rate?\n",
          "Counter3: unknown key exec_ctx.periodic.rate; did you mean exec_cxt.periodic.rate?\n",
          "Counter4: unknown key rate; did you mean exec_cxt.periodic.rate?\n",
          "Counter5: unknown key execution_rate; did you mean exec_cxt.periodic.rate?\n",
          "Counter6: ec.slow.rate: the component has no execution context slow (it has: "
          "PeriodicExecutionContext)\n",
          "Counter7: unknown key periodic.rate; did you mean exec_cxt.periodic.rate?\n"}) {
        INFO(host.errors);
        const auto found = host.errors.find(line);
        CHECK(found != std::string::npos);
        if (found != std::string::npos) CHECK(host.errors.find(line, found + 1) == std::string::npos);
    }
}

TEST_CASE("A component that throws goes to the error state and its host keeps running") {
    Folder folder;
    HostProcess host({"-f", folder.conf("manager.modules.preload: TestComponents.so\n"
                                        "manager.components.precreate: Thrower\n"
                                        "manager.components.preactivation: Thrower0\n")});
    REQUIRE(host.wait_for_output("ready\n"));
    REQUIRE(host.wait_for_output("aborting\n"));
    const bool is_told = host.wait_for_error("Thrower0: went to ERROR: its onExecute has failed\n");
    INFO(host.errors);
    CHECK(is_told);
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
    CHECK(host.errors.find("Thrower0: onExecute threw: on purpose") != std::string::npos);
}

TEST_CASE("A component that another one removes while the host ends is finalized once, and the host ends in "
          "order") {
    Folder folder;
    HostProcess host({"-f", folder.conf("manager.modules.preload: TestComponents.so\n"
                                        "manager.components.precreate: Counter, Reporter, Remover\n")});
    REQUIRE(host.wait_for_output("ready\n"));
    host.send_signal(SIGTERM);
    INFO(host.errors);
    CHECK(host.wait_for_exit() == 0);
    const auto first = host.output.find("Reporter0 finalized\n");
    REQUIRE(first != std::string::npos);
    CHECK(host.output.find("Reporter0 finalized\n", first + 1) == std::string::npos);
}

TEST_CASE(
    "A host without any component says so in its last line unless it is a master that waits for tools") {
    using Catch::Contains;
    Folder folder;
    HostProcess misspelt({"-f", folder.conf("manager.modules.preloads: TestComponents.so\n"
                                            "manager.components.precreates: Reporter\n")});
    CHECK(misspelt.wait_for_output("ready, but nothing was loaded\n"));
    CHECK_THAT(misspelt.errors, Contains("manager.modules.preloads"));
    HostProcess modules({"-f", folder.conf("manager.modules.preload: TestComponents.so\n")});
    CHECK(modules.wait_for_output("ready, but no component was created\n"));
    HostProcess master({"-d", "-f", "/dev/null"});
    CHECK(master.wait_for_output("ready\n"));
    for (auto* host : {&misspelt, &modules, &master}) {
        host->send_signal(SIGTERM);
        CHECK(host->wait_for_exit() == 0);
    }
}

TEST_CASE("An exception of any type in any callback is logged in one line and the host keeps running") {
    const std::vector<std::string> callbacks{"Startup", "Activated", "Execute",     "StateUpdate", "Aborting",
                                             "Error",   "Shutdown",  "Deactivated", "Finalize"};
    for (const std::string how : {"int", "corba", "std"}) {
        std::vector<std::unique_ptr<Folder>> folders;
        std::vector<std::unique_ptr<HostProcess>> hosts;
        for (const auto& callback : callbacks) {
            std::string in = callback == "StateUpdate" ? "update" : callback;
            in[0] = static_cast<char>(std::tolower(in[0]));
            folders.push_back(std::make_unique<Folder>(callback));
            hosts.push_back(std::make_unique<HostProcess>(std::vector<std::string>{
                "-f",
                folders.back()->conf("manager.modules.preload: TestComponents.so\n"
                                     "manager.components.precreate: Counter, Reporter, FaultInjector?how=" +
                                     how + "&in=" + in +
                                     "\nmanager.components.preconnect: Counter0.out?port=Reporter0.in\n"
                                     "manager.components.preactivation: Counter0, Reporter0, FaultInjector0\n"
                                     "exec_cxt.periodic.rate: 100\n")}));
        }
        for (auto& host : hosts) {
            CHECK(host->wait_for_output("ready\n"));
            CHECK(host->wait_for_output("received ")); // the other components keep running
            host->send_signal(SIGTERM);
        }
        const std::string expected = how == "int"   ? "something that is not"
                                     : how == "std" ? ": on purpose"
                                                    : "NO_MEMORY";
        for (std::size_t i = 0; i < hosts.size(); ++i) {
            CAPTURE(how, callbacks[i], hosts[i]->output, hosts[i]->errors);
            CHECK(hosts[i]->wait_for_exit() == 0);
            const std::string line = "FaultInjector0: on" + callbacks[i] + " threw";
            const std::size_t at = hosts[i]->errors.find(line);
            REQUIRE(at != std::string::npos);
            CHECK(hosts[i]->errors.find(expected, at) != std::string::npos);
            CHECK(hosts[i]->errors.find(line, at + 1) == std::string::npos);
            CHECK(hosts[i]->output.find("Reporter0 finalized") != std::string::npos);
        }
    }
}

TEST_CASE("A host does not start with a component whose onInitialize throws") {
    using Catch::Contains;
    for (const std::string how : {"int", "corba", "std"}) {
        Folder folder;
        HostProcess host({"-f", folder.conf("manager.modules.preload: TestComponents.so\n"
                                            "manager.components.precreate: FaultInjector?in=initialize&how=" +
                                            how + "\n")});
        CHECK(host.wait_for_exit() == 1);
        CHECK_THAT(host.errors,
                   Contains("FaultInjector0: onInitialize threw") && Contains("cannot be started"));
    }
}

TEST_CASE("A component that ends the process does so with its own exit code and in time") {
    const std::vector<std::string> callbacks{"initialize", "startup",  "activated",   "execute",
                                             "update",     "shutdown", "deactivated", "finalize"};
    for (const auto& [how, code] : {std::pair("exit", 7), {"abort", -SIGABRT}})
        for (const auto& callback : callbacks) {
            CAPTURE(how, callback);
            Folder folder;
            HostProcess host(
                {"-f", folder.conf("manager.modules.preload: TestComponents.so\n"
                                   "manager.components.precreate: Reporter, FaultInjector?in=" +
                                   callback + "&how=" + how +
                                   "\nmanager.components.preactivation: Reporter0, FaultInjector0\n"
                                   "exec_cxt.periodic.rate: 100\n")});
            // The others come by themselves, the first onExecute perhaps after `ready`.
            if (callback == "shutdown" || callback == "deactivated" || callback == "finalize") {
                CHECK(host.wait_for_output("ready\n"));
                host.send_signal(SIGTERM);
            }
            CHECK(host.wait_for_exit() == code);
        }
}

TEST_CASE("In lock-step mode components run when the driver requests it and at no other time") {
    Folder folder;
    const std::string socket = (folder.path / "steps").string();
    HostProcess host({"-f", folder.conf(pair_conf), "--lockstep", socket});
    REQUIRE(host.wait_for_output("ready\n"));
    tandem::rt::StepClient driver(socket, std::chrono::seconds(10));
    for (int i = 0; i < 9; ++i) {
        driver.step("Counter0");
        driver.step("Reporter0");
    }
    CHECK_FALSE(host.wait_for_output("received", std::chrono::seconds(0)));
    driver.step("Counter0");
    driver.step("Reporter0");
    CHECK(host.wait_for_output("received 10\n", std::chrono::seconds(10)));
    CHECK_THROWS_WITH(driver.step("Nobody"), Catch::Contains("there is no component Nobody"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("A manager without components ends by itself unless it is configured to stay") {
    const std::string soon = "manager.auto_shutdown_duration:0.2";
    CHECK(HostProcess({"-o", soon}).wait_for_exit() == 0);
    CHECK(HostProcess({"-i", "-f", "/no/such/rtc.conf", "-o", soon}).wait_for_exit() == 0);
    for (const std::vector<std::string>& stay : {std::vector<std::string>{"-d"},
                                                 {"-o", "manager.shutdown_auto:NO"},
                                                 {"-o", "manager.is_master:YES"}}) {
        auto arguments = stay;
        arguments.insert(arguments.end(), {"-o", soon, "-o", "corba.master_manager:" + unused_port()});
        HostProcess host(arguments);
        REQUIRE(host.wait_for_output("ready"));
        CHECK(host.wait_for_exit(std::chrono::seconds(1)) == -1000);
        host.send_signal(SIGTERM);
        CHECK(host.wait_for_exit() == 0);
    }
}

TEST_CASE("A master manager is found at the port of corba.master_manager beside its own endpoint") {
    const std::string own = unused_port(), masters = unused_port();
    HostProcess host({"-d", "-p", own, "-o", "corba.master_manager:localhost:" + masters});
    REQUIRE(host.wait_for_output("ready\n"));
    CHECK(is_listening(own));
    CHECK(is_listening(masters));
    // The second master of a machine says which port it wants.
    HostProcess second({"-o", "manager.is_master:YES", "-o", "corba.master_manager::" + masters});
    CHECK(second.wait_for_exit() == 1);
    CHECK_THAT(second.errors, Catch::Contains("giop:tcp:127.0.0.1:" + masters) &&
                                  Catch::Contains("manager.is_master adds corba.master_manager"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("Modules of OpenRTM-aist that rtc.conf files name are passed over or explained in one line") {
    using Catch::Contains;
    HostProcess host({"-o", "logger.log_level:INFO", "-o",
                      "manager.modules.preload:ComponentObserverConsumer.so, /opt/sdo/LoggerConsumer.so"});
    REQUIRE(host.wait_for_output("ready"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
    CHECK_THAT(host.errors, Contains("module ComponentObserverConsumer.so of OpenRTM-aist is passed over: "));
    CHECK_THAT(host.errors, Contains("module /opt/sdo/LoggerConsumer.so of OpenRTM-aist is passed over: "));
    CHECK_THAT(
        refusal(std::vector<std::string>{"-o", "manager.modules.preload:OpenSpliceTransport.so"}),
        Contains("module OpenSpliceTransport.so of OpenRTM-aist is not available here; data ports offer"));
}
