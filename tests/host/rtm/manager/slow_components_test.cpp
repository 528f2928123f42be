// SPDX-License-Identifier: Apache-2.0
// Components of rtm_host whose callbacks take long or never return.
#include "tests/host/rtm/host_process.hpp"
#include "tests/host/rtm/manager/conf_folder.hpp"

#include <catch2/catch.hpp>
#include <memory>

using testing::HostProcess;
using Folder = testing::ConfFolder;

TEST_CASE("A component that hangs does not keep its host from ending") {
    Folder folder;
    HostProcess host({"-f",
                      folder.conf("manager.modules.preload: TestComponents.so\n"
                                  "manager.components.precreate: Reporter, HangingComponent\n"
                                  "manager.components.preactivation: Reporter0, HangingComponent0\n"),
                      "--grace", "1"});
    REQUIRE(host.wait_for_output("hanging\n"));
    REQUIRE(host.wait_for_output("ready\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 1);
    CHECK(host.output.find("Reporter0 finalized") != std::string::npos);
    CHECK_THAT(host.errors, Catch::Contains("exiting without waiting for onExecute of HangingComponent0\n"));
}

TEST_CASE("The other components and the host end cleanly whichever callback of a component hangs and it is "
          "named") {
    const std::vector<std::string> callbacks{"initialize",  "startup",  "activated", "execute",
                                             "update",      "rate",     "aborting",  "error",
                                             "deactivated", "shutdown", "finalize"};
    const std::vector<std::string> names{"onInitialize",  "onStartup",     "onActivated", "onExecute",
                                         "onStateUpdate", "onRateChanged", "onAborting",  "onError",
                                         "onDeactivated", "onShutdown",    "onFinalize"};
    std::vector<std::unique_ptr<Folder>> folders;
    std::vector<std::unique_ptr<HostProcess>> hosts; // side by side: each takes seconds to give up
    for (const auto& callback : callbacks) {
        folders.push_back(std::make_unique<Folder>(callback));
        hosts.push_back(std::make_unique<HostProcess>(std::vector<std::string>{
            "-f",
            folders.back()->conf("manager.modules.preload: TestComponents.so\n"
                                 "manager.components.precreate: Reporter, FaultInjector?in=" +
                                 callback +
                                 "\n"
                                 "manager.components.preactivation: Reporter0, FaultInjector0\n"
                                 "exec_cxt.periodic.rate: 100\n"),
            "--grace", "2"}));
    }
    for (std::size_t i = 0; i < hosts.size(); ++i) {
        const bool at_the_end = i >= 8; // called only when the host ends
        CAPTURE(callbacks[i]);
        CHECK(hosts[i]->wait_for_output(at_the_end ? "ready\n" : "asleep\n"));
        hosts[i]->send_signal(SIGTERM);
    }
    for (std::size_t i = 0; i < hosts.size(); ++i) {
        CAPTURE(callbacks[i], hosts[i]->output, hosts[i]->errors);
        CHECK(hosts[i]->wait_for_exit() == 1);
        CHECK(hosts[i]->output.find("asleep\n") != std::string::npos);
        // onInitialize and onStartup are called while the component is created.
        const std::string named =
            i < 2 ? "onInitialize or onStartup of component FaultInjector0 does not return within 2 s"
                  : names[i] + " of FaultInjector0 does not return; the host continues";
        CHECK_THAT(hosts[i]->errors, Catch::Contains(named));
        CHECK(hosts[i]->output.find("Reporter0 finalized") != std::string::npos);
    }
}

TEST_CASE(
    "A slow onActivated is not an error: the host says that it waits and when the component is ACTIVE or "
    "in ERROR") {
    using Catch::Contains;
    Folder folder;
    HostProcess host(
        {"-f",
         folder.conf("manager.modules.preload: TestComponents.so\n"
                     "manager.components.precreate: SlowDevice?in=activated&ms=2500, "
                     "SlowDevice?in=activated&ms=700&fails=YES, SlowDevice?in=activated&ms=0&fails=YES\n"
                     "manager.components.preactivation: SlowDevice0, SlowDevice1, SlowDevice2\n")});
    REQUIRE(host.wait_for_output("ready\n"));
    CHECK(host.wait_for_error("SlowDevice0 is still activating: onActivated has taken 0."));
    CHECK(host.wait_for_error("onActivated of SlowDevice0 has taken 2 s so far\n"));
    CHECK(host.wait_for_error("onActivated of SlowDevice0 has returned within "));
    CHECK(host.wait_for_error(" s; SlowDevice0 is ACTIVE\n"));
    CHECK(host.wait_for_error(" s; SlowDevice1 is ERROR\n"));
    CHECK_THAT(host.errors, Contains("SlowDevice2: went to ERROR: its onActivated has failed\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("A slow onInitialize or onDeactivated is waited for, and the host says so") {
    using Catch::Contains;
    Folder folder;
    HostProcess host({"-f", folder.conf("manager.modules.preload: TestComponents.so\n"
                                        "manager.components.precreate: SlowDevice?in=initialize&ms=2500, "
                                        "SlowDevice?in=deactivated&ms=4500\n"
                                        "manager.components.preactivation: SlowDevice1\n")});
    REQUIRE(host.wait_for_output("ready\n"));
    CHECK_THAT(host.errors, Contains("onInitialize or onStartup of component SlowDevice0 has taken 2 s so "
                                     "far; Ctrl-C ends the host\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
    CHECK_THAT(host.errors,
               Contains("onDeactivated of SlowDevice1 has taken 2 s so far; the host waits for it\n") &&
                   Contains("onDeactivated of SlowDevice1 has taken 4 s so far") &&
                   !Contains("without waiting"));
    CHECK_THAT(host.output, Contains("device closed\ndevice closed\n"));
}

TEST_CASE("A component that can neither initialize nor be destroyed does not block its host") {
    using Catch::Contains;
    Folder folder;
    HostProcess host({"-f",
                      folder.conf("manager.modules.preload: TestComponents.so\n"
                                  "manager.components.precreate: FaultInjector?in=initialize&how=fail\n"),
                      "--grace", "1"});
    CHECK(host.wait_for_exit() == 1);
    CHECK_THAT(host.errors, Contains("the destructor of FaultInjector0 does not return") &&
                                Contains("FaultInjector0 cannot be started: its onInitialize has failed"));
}

TEST_CASE("Neither a read of stdin nor a static destructor keeps the host from ending") {
    for (const auto& [how, said, line] :
         {std::tuple("stdin", "reads\n", "exiting without waiting for onExecute of FaultInjector0\n"),
          {"static", "is there\n", "static destructors do not return"}}) {
        CAPTURE(how);
        Folder folder;
        HostProcess host(
            {"-f",
             folder.conf("manager.modules.preload: TestComponents.so\n"
                         "manager.components.precreate: Reporter, FaultInjector?in=execute&how=" +
                         std::string(how) +
                         "\nmanager.components.preactivation: Reporter0, FaultInjector0\n"),
             "--grace", "2"});
        REQUIRE(host.wait_for_output("ready\n"));
        REQUIRE(host.wait_for_output(said));
        host.send_signal(SIGTERM);
        CHECK(host.wait_for_exit() == 1);
        CHECK(host.errors.find(line) != std::string::npos);
        CHECK(host.output.find("Reporter0 deactivated\n") != std::string::npos);
    }
}
