// SPDX-License-Identifier: Apache-2.0
// opros_host: runs an OPRoS application until it is told to stop.
#include "host/opros/src/application.hpp"
#include "host/rt/thread.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sstream>

namespace {

using tandem::engine::ApplicationOptions;

struct Options {
    std::filesystem::path application;
    ApplicationOptions host;
    long spin_us = 0;
    bool keep_going = false, low_latency_idle = false, lock_memory = false, parent_death = false;
};

void declare(CLI::App& cli, Options& options) {
    cli.add_option("application", options.application, "Application profile (XML)")->required();
    cli.add_option("--plugin-path", options.host.plugin_dirs, "Folder with component libraries (repeatable)")
        ->allow_extra_args(false);
    cli.add_option("--lockstep", options.host.lockstep_socket,
                   "Step components through this socket, no executors");
    cli.add_option("--cpu", options.host.executors.cpu, "Pin executors to this processor");
    cli.add_option("--tick-spin", options.spin_us, "Poll the last US microseconds before a tick");
    cli.add_option("--workers", options.host.workers, "Threads for events and non-blocking calls")
        ->check(CLI::Range(1, 64));
    cli.add_flag("--keep-going", options.keep_going,
                 "Run without components that fail to initialize or start");
    cli.add_flag("--low-latency-idle", options.low_latency_idle, "Keep processors out of deep idle states");
    cli.add_flag("--lock-memory", options.lock_memory, "Lock the process in memory");
    cli.add_flag("--parent-death", options.parent_death, "Leave in order when the parent process dies");
}

// The environment, then what lies beside the program: in the build tree, then as installed.
void add_default_plugin_dirs(std::vector<std::filesystem::path>& dirs) {
    const char* variable = std::getenv("TANDEM_PLUGIN_PATH");
    std::istringstream listed(variable ? variable : "");
    for (std::string dir; std::getline(listed, dir, ':');)
        if (!dir.empty()) dirs.emplace_back(dir);
    const auto prefix = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
    dirs.push_back(prefix / "plugins" / "opros");
    dirs.push_back(prefix / TANDEM_INSTALLED_PLUGINS);
}

void apply(const Options& options) {
    const auto tell = [](const std::optional<std::string>& notice) {
        if (notice) spdlog::info("{}", *notice);
    };
    if (options.lock_memory) tell(tandem::rt::lock_memory());
    if (options.low_latency_idle) tell(tandem::rt::hold_low_latency_idle());
    if (options.parent_death) tell(tandem::rt::end_with_parent());
}

sigset_t ending_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    return signals;
}

int run(const Options& options) {
    const sigset_t signals = ending_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr); // before any thread exists: all inherit it
    apply(options);
    tandem::engine::Application application(options.application, options.host);
    application.start();
    std::cout << "ready" << std::endl;
    int signal = 0;
    sigwait(&signals, &signal);
    spdlog::info("stopping on {}", strsignal(signal));
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr); // a second one ends a component that will not stop
    application.stop();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_logger_mt("opros_host"));
    spdlog::set_pattern("%H:%M:%S.%e %n %l: %v");
    Options options;
    CLI::App cli("Runs an OPRoS application: its components, from their libraries and profiles.");
    declare(cli, options);
    CLI11_PARSE(cli, argc, argv);
    options.host.strict = !options.keep_going;
    options.host.executors.spin = std::chrono::microseconds(options.spin_us);
    try {
        add_default_plugin_dirs(options.host.plugin_dirs);
        return run(options);
    } catch (const std::exception& error) {
        std::cerr << "opros_host: " << error.what() << std::endl;
        return 1;
    }
}
