// SPDX-License-Identifier: Apache-2.0
#include "host/process/run_command.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

using Catch::Contains;
using tandem::process::CommandResult;

/// A folder for one test, removed at its end.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tandem_crash." + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
        return path / name;
    }
};

/// Runs rtm_host with three tanks. The second one has the fault.
CommandResult run_rtm(const std::string& fault) {
    const Folder folder;
    const std::string conf =
        folder.write("rtc.conf", "manager.modules.load_path: " TANDEM_TEST_PLUGINS
                                 "\nmanager.modules.preload: TankRtc.so\n"
                                 "manager.components.precreate: TankRtc, TankRtc, TankRtc\n"
                                 "manager.components.preactivation: TankRtc0, TankRtc1, TankRtc2\n"
                                 "test.TankRtc1.conf.default.fault: " +
                                     fault + "\nexec_cxt.periodic.rate: 100\n");
    return tandem::process::run_command({TANDEM_RTM_HOST, "-f", conf});
}

/// Runs opros_host with three tanks. The second one has the fault.
CommandResult run_opros(const std::string& fault) {
    const Folder folder;
    std::string components;
    for (const std::string name : {"Tank0", "Tank1", "Tank2"}) {
        folder.write(name + ".xml",
                     "<component_profile><name>" + name +
                         "</name><execution_environment><library_name>TankComp"
                         "</library_name></execution_environment><execution_semantics><type>periodic</type>"
                         "<period>10</period></execution_semantics><properties><property name=\"fault\">" +
                         (name == "Tank1" ? fault : "") + "</property></properties></component_profile>\n");
        components +=
            "<subcomponent><name>" + name + "</name><reference>" + name + ".xml</reference></subcomponent>";
    }
    const std::string application = folder.write(
        "app.xml", "<package_profile><name>app</name><subcomponents>" + components +
                       "</subcomponents><port_connections></port_connections></package_profile>\n");
    return tandem::process::run_command(
        {TANDEM_OPROS_HOST, "--plugin-path", TANDEM_TEST_PLUGINS, application});
}

/// The block: from its first line to the end, the host writes nothing after it.
std::string block(const CommandResult& result, const std::string& host) {
    const auto begin = result.errors.find(host + ": component ");
    return begin == std::string::npos ? "no block in:\n" + result.errors : result.errors.substr(begin);
}

struct Expected {
    const char* fault;
    int signal;
    const char *what, *function;
    const char* elsewhere = what; ///< on processors that tell any address
};
const std::vector<Expected> all_faults{
    {"null pointer", SIGSEGV, "signal 11 (Segmentation fault), no memory at address 0x0, in read_level at 0x",
     "have_fault  ("},
    {"null function", SIGSEGV,
     "signal 11 (Segmentation fault), no memory at address 0x0, called address 0x0 without code, in "
     "have_fault at 0x",
     "::onExecute  ("},
    {"stack overflow", SIGSEGV,
     "signal 11 (Segmentation fault), the thread's stack has overflowed at address 0x", "recurse  ("},
    {"division by zero", SIGFPE,
     "signal 8 (Floating point exception), integer division by zero, in have_fault at 0x", "::onExecute  ("},
#ifndef SANITIZED // whose allocator finds it by itself
    {"damaged heap", SIGSEGV, "signal 11 (Segmentation fault), address not known, in have_fault at 0x",
     "::onExecute  (", "signal 11 (Segmentation fault), no memory at address 0x"},
#endif
    {"abort", SIGABRT, "signal 6 (Aborted), in have_fault at 0x", "::onExecute  ("},
};

/// Tries in a child process whether an integer division by zero is a fault. On arm64 the result is 0.
[[gnu::no_sanitize("undefined")]] bool is_division_by_zero_a_fault() { // UBSan would end the child
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGFPE, SIG_DFL);
        volatile int zero = 0;
        _exit(7 / zero);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status);
}

/// Returns the faults that this processor has.
std::vector<Expected> faults() {
    std::vector<Expected> found = all_faults;
    if (!is_division_by_zero_a_fault()) { // such a processor also tells the address of every fault
        std::erase_if(found, [](const Expected& fault) { return fault.signal == SIGFPE; });
        for (Expected& fault : found) fault.what = fault.elsewhere;
    }
    return found;
}

void check_block(const CommandResult& result, const Expected& expected, const std::string& host,
                 const std::string& component, const std::string& plugin) {
    const std::string text = block(result, host);
    INFO(text);
    CHECK(result.status.signalled);
    CHECK(result.status.code == expected.signal);
    const std::string crashed = host + ": component " + component + " crashed in onExecute: ";
    CHECK_THAT(text, Catch::StartsWith(crashed + expected.what));
    CHECK_THAT(text,
               Contains("  plugin " TANDEM_TEST_PLUGINS "/" + plugin + "\n") && Contains("\n  thread "));
    CHECK_THAT(text, Contains("  #0  ") && Contains(expected.function));
    CHECK_THAT(text, Contains("/" + plugin + " +0x"));
    // One block, and only of the component that has crashed.
    CHECK(text.find("crashed in", text.find("crashed in") + 1) == std::string::npos);
}

} // namespace

TEST_CASE(
    "rtm_host names the RTC that crashes, its callback, plugin, fault and calls, then ends by the signal") {
    const Expected expected = GENERATE(from_range(faults()));
    check_block(run_rtm(expected.fault), expected, "rtm_host", "TankRtc1", "TankRtc.so");
}

TEST_CASE("opros_host names the component that crashes, its callback, plugin, fault and calls") {
    const Expected expected = GENERATE(from_range(faults()));
    check_block(run_opros(expected.fault), expected, "opros_host", "Tank1", "TankComp.so");
}

TEST_CASE("An uncaught exception in a component's own thread is reported with its type and text") {
    const bool rtm = GENERATE(true, false);
    const CommandResult result = rtm ? run_rtm("own thread") : run_opros("own thread");
    INFO(result.errors);
    CHECK(result.status.signalled);
    CHECK(result.status.code == SIGABRT);
    CHECK_THAT(result.errors,
               Contains(std::string(rtm ? "rtm_host" : "opros_host") +
                        ": crashed outside of the callbacks of components: an uncaught exception of type "
                        "std::runtime_error: valve 3 does not answer, in watch_valve at 0x"));
    CHECK_THAT(result.errors,
               Contains("watch_valve  (") && Contains(rtm ? "/TankRtc.so +0x" : "/TankComp.so +0x"));
}
