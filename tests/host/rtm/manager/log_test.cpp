// SPDX-License-Identifier: Apache-2.0
// The log of rtm_host when nobody reads it, or its disk is full.
#include "tests/host/rtm/host_process.hpp"
#include <catch2/catch.hpp>

using testing::HostProcess;

namespace {

std::vector<std::string> chatterbox(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"-i", "-f", "/nonexistent.conf"};
    for (const char* setting :
         {"manager.modules.load_path: " TANDEM_TEST_PLUGINS, "manager.modules.preload: TestComponents.so",
          "manager.components.precreate: Chatterbox", "manager.components.preactivation: Chatterbox0",
          "exec_cxt.periodic.rate: 1000"})
        arguments.insert(arguments.end(), {"-o", setting});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

} // namespace

TEST_CASE("a component keeps running while its log is not read, and the lost lines are counted") {
    HostProcess host(chatterbox());
    host.stall_errors(true);
    CHECK(host.wait_for_output("logged\n"));
    host.stall_errors(false);
    CHECK(host.wait_for_error("lines of the log could not be written (no process reads it)"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("one signal ends a host whose RTCs write a log that is not read") {
    HostProcess host(chatterbox());
    host.stall_errors(true);
    CHECK(host.wait_for_output("logged\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("a full disk under a log file does not stop a component") {
    HostProcess host(chatterbox({"-o", "logger.file_name: /dev/full"}));
    CHECK(host.wait_for_output("logged\n"));
    host.send_signal(SIGTERM);
    CHECK(host.wait_for_exit() == 0);
}

TEST_CASE("a misspelt property of a preconnected connection is a warning with what was probably meant") {
    auto arguments = chatterbox();
    arguments.insert(arguments.end(), {"-o", "manager.components.precreate: Counter, Reporter", "-o",
                                       "manager.components.preconnect: "
                                       "Counter0.out?port=Reporter0.in&dataflow_typ=push",
                                       "-o", "manager.components.preactivation: Counter0, Reporter0"});
    HostProcess host(arguments);
    CHECK(host.wait_for_output("received 10\n")); // the connection is made with the default
    CHECK(host.wait_for_error(
        "manager: manager.components.preconnect: "
        "`Counter0.out?port=Reporter0.in&dataflow_typ=push`: unknown key dataflow_typ; did "
        "you mean dataflow_type?"));
}
