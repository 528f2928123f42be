// SPDX-License-Identifier: Apache-2.0
// opros_host: runs an OPRoS application until a signal (SIGINT, SIGTERM, SIGHUP) ends it. It prints `ready` on standard
// output when the components have started (`ready, but ...` if some have not).
#include "host/crash/crash_report.hpp"
#include "host/log/log.hpp"
#include "host/log/output_failures.hpp"
#include "host/opros/control/control_server.hpp"
#include "host/opros/engine/application.hpp"
#include "host/opros/engine/load/load_probe.hpp"
#include "host/opros/program/shutdown_watcher.hpp"
#include "host/options/opros_host_options.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/process/bounded_call.hpp"
#include "host/process/exit/exit_guard.hpp"
#include "host/process/exit/exit_process.hpp"
#include "host/process/ready_line.hpp"
#include "host/text/printable.hpp"
#include "shm/segment/dead_segments.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>

namespace {

using tandem::options::OprosHostOptions;

sigset_t shutdown_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    return signals;
}

/// Folders of --plugin-path come first.
tandem::engine::ApplicationOptions application_options(const OprosHostOptions& options) {
    tandem::engine::ApplicationOptions result;
    result.plugin_dirs = options.plugin_dirs;
    const auto dirs = tandem::plugin::default_plugin_dirs("opros");
    result.plugin_dirs.insert(result.plugin_dirs.end(), dirs.begin(), dirs.end());
    result.probe = options.probe.probe_options();
    result.executors.cpu = options.real_time.cpu;
    result.executors.tick_spin = options.real_time.tick_spin();
    result.lockstep_socket = options.lockstep_socket;
    result.strict = options.strict;
    result.node = options.node;
    result.grace = options.grace();
    return result;
}

std::string ready_line(const tandem::engine::Application& application) {
    const auto missing = application.components_not_running();
    if (missing.empty()) return "ready";
    return tandem::text::printable_line(
        fmt::format("ready, but {} has not started", fmt::join(missing, ", ")));
}

/// Sets up the application, runs it and ends it. Returns exit code 1 if a hanging component had to be left behind.
int run(const OprosHostOptions& options) {
    const sigset_t signals = shutdown_signals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr); // before any other thread exists: all inherit it
    for (const auto& notice : tandem::options::apply(options.real_time)) tandem::log::warn("{}", notice);
    auto host = application_options(options);
    tandem::engine::ShutdownWatcher shutdown_watcher(signals, host.grace);
    host.on_setup_step = [&shutdown_watcher](const std::string& component, const char* callback) {
        shutdown_watcher.begin_step(component, callback);
    };
    host.is_ending = shutdown_watcher.signalled();
    // After the watcher, and before any component, because a component may call exit() during set-up.
    const tandem::process::ExitGuard exit_guard;
    tandem::engine::Application application(options.application, host);
    application.start();
    tandem::control::ControlServer control(application, options.application.string());
    tandem::process::write_ready_line(ready_line(application));
    shutdown_watcher.wait_for_signal();
    control.close();
    application.shut_down();
    // A request that waits for a hanging component does not end.
    const bool requests_have_ended = control.stop_within(
        application.stuck_components().empty() ? host.grace : std::chrono::nanoseconds(0));
    if (options.stats)
        for (const std::string& line : application.executor_stats())
            std::cout << tandem::text::printable_line(line) << "\n";
    if (!requests_have_ended) tandem::process::exit_process(1);
    application.unload();
    if (!application.stuck_components().empty()) tandem::process::exit_process(1);
    if (const auto loaded = application.components_still_loaded(); !loaded.empty())
        tandem::process::set_exit_timeout(
            host.grace, fmt::format("opros_host: component {} does not return from its static "
                                    "destructors within {} s; the host exits without it",
                                    fmt::join(loaded, " or "), options.grace_s));
    tandem::shm::remove_dead_segments();
    return 0;
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside try, only a mistake in an option's declaration throws
int main(int argc, char** argv) {
    // Must be first: does not return in the child process of a probe.
    tandem::plugin::serve_probe(argc, argv,
                                {{tandem::engine::load_probe_task, tandem::engine::run_load_probe}});
    tandem::crash::install_crash_report("opros_host");
    tandem::log::hold_standard_streams();
    tandem::log::outlive_output_failures();
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // output of components precedes the error that it explains
    tandem::log::open("opros_host");
    tandem::process::set_log_flush(tandem::log::flush);
    int exit_code = 0;
    const auto options = tandem::options::parse_opros_host_options(argc, argv, exit_code);
    if (!options) return exit_code;
    tandem::shm::remove_dead_segments();
    try {
        const int code = run(*options);
        tandem::process::flush_or_exit(code);
        return code;
    } catch (const std::exception& error) {
        tandem::log::print("opros_host: " + tandem::text::printable_line(error.what()));
        // A hanging component thread would crash while static objects are destroyed.
        if (tandem::process::BoundedCall::any_running()) tandem::process::exit_process(1);
        return 1;
    }
}
