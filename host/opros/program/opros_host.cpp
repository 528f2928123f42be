// SPDX-License-Identifier: Apache-2.0
// opros_host: runs an OPRoS application until a signal (SIGINT, SIGTERM, SIGHUP) asks it to end.
#include "host/crash/crash_report.hpp"
#include "host/opros/engine/application.hpp"
#include "host/opros/engine/load/load_probe.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"
#include "host/opros/program/shutdown_watcher.hpp"
#include "host/options/probe_cli_options.hpp"
#include "host/options/real_time_options.hpp"
#include "host/process/bounded_call.hpp"
#include "host/process/exit_guard.hpp"
#include "host/process/exit_process.hpp"
#include "shm/segment/dead_segments.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <tandem_version.hpp>

namespace {

using tandem::engine::ApplicationOptions;

/// The command line.
struct Options {
    std::filesystem::path application;
    ApplicationOptions host;
    tandem::options::RealTimeOptions real_time;
    tandem::options::ProbeCliOptions probe;
    double grace_s = 10;
    bool stats = false;
};

void declare(CLI::App& cli, Options& options) {
    cli.add_option("application", options.application, "Application profile (XML)")->required();
    cli.add_option("--plugin-path", options.host.plugin_dirs, "Folder with component libraries (repeatable)")
        ->allow_extra_args(false);
    cli.add_option("--lockstep", options.host.lockstep_socket,
                   "Step components through this socket, no executors");
    cli.add_flag("--strict", options.host.strict,
                 "Do not run without a component that fails to load, initialize or start, or a connection");
    cli.add_option("--grace", options.grace_s,
                   "Seconds that the end waits for each callback of a component to return")
        ->check(CLI::Range(0.01, 3600.));
    cli.add_flag("--stats", options.stats, "Print the executors' ticks and overruns at the end");
    tandem::options::add_library_probe_options(cli, options.probe);
    tandem::options::add_real_time_options(cli, options.real_time);
}

sigset_t shutdown_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    return signals;
}

/// Sets up the application, runs it and ends it. The exit code is 1 when a component had to be left behind.
int run(Options options) {
    const sigset_t signals = shutdown_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr); // before any thread exists: all inherit it
    for (const auto& notice : tandem::options::apply(options.real_time)) spdlog::warn("{}", notice);
    tandem::engine::ShutdownWatcher shutdown_watcher(signals, options.host.grace);
    options.host.on_setup_step = [&shutdown_watcher](const std::string& component, const char* callback) {
        shutdown_watcher.begin_step(component, callback);
    };
    options.host.is_ending = shutdown_watcher.signalled();
    // After the watcher and before any component: a component may call exit() in its set-up.
    const tandem::process::ExitGuard exit_guard;
    tandem::engine::Application application(options.application, options.host);
    application.start();
    std::cout << "ready" << std::endl; // supervisors and tests wait for this line
    shutdown_watcher.wait_for_signal();
    application.shut_down();
    if (options.stats)
        for (const std::string& line : application.executor_stats()) std::cout << line << "\n";
    application.unload();
    if (!application.stuck_components().empty()) tandem::process::exit_process(1);
    if (const auto loaded = application.components_still_loaded(); !loaded.empty())
        tandem::process::set_exit_timeout(
            options.host.grace, fmt::format("opros_host: component {} does not return from its static "
                                            "destructors within {} s; the host exits without it",
                                            fmt::join(loaded, " or "), options.grace_s));
    tandem::shm::remove_dead_segments();
    return 0;
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside of try only a mistake in the declaration of an option throws
int main(int argc, char** argv) {
    // First of all: as the child process of a probe this does not return.
    tandem::plugin::serve_probe(argc, argv,
                                {{tandem::engine::load_probe_task, tandem::engine::run_load_probe}});
    tandem::crash::install_crash_report("opros_host");
    spdlog::set_default_logger(spdlog::stderr_logger_mt("opros_host"));
    spdlog::set_pattern("%H:%M:%S.%e %n %l: %v");
    Options options;
    CLI::App cli("Runs an OPRoS application: its components, from their libraries and profiles.");
    cli.set_version_flag("--version", std::string("opros_host ") + tandem::version);
    declare(cli, options);
    CLI11_PARSE(cli, argc, argv);
    tandem::shm::remove_dead_segments();
    options.host.probe = options.probe.probe_options();
    options.host.grace = std::chrono::nanoseconds(static_cast<std::int64_t>(options.grace_s * 1e9));
    options.host.executors.cpu = options.real_time.cpu;
    options.host.executors.tick_spin = options.real_time.tick_spin();
    try {
        const auto dirs = tandem::engine::default_plugin_dirs();
        options.host.plugin_dirs.insert(options.host.plugin_dirs.end(), dirs.begin(), dirs.end());
        return run(options);
    } catch (const std::exception& error) {
        std::cerr << "opros_host: " << error.what() << std::endl;
        // A thread of a component that hangs would crash in static objects that are being destroyed.
        if (tandem::process::BoundedCall::any_running()) tandem::process::exit_process(1);
        return 1;
    }
}
