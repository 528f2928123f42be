// SPDX-License-Identifier: Apache-2.0
// rtm_host: runs the RT-Components that an rtc.conf names, as OpenRTM-aist's rtcd does, with the same options.
// It prints `ready` on standard output when all of rtc.conf has been carried out (`ready, but ...` if there is no
// component), and ends on SIGINT, SIGTERM and SIGHUP. Exit code 0: it ended cleanly; 1: bad input, or a component's
// code did not return and was left behind; any other: the code that a component passed to exit().
#include "host/log/log.hpp"
#include "host/log/output_failures.hpp"
#include "host/options/rtm_host_options.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/process/exit/exit_guard.hpp"
#include "host/process/exit/exit_process.hpp"
#include "host/process/ready_line.hpp"
#include "host/process/start_thread.hpp"
#include "host/process/step_timer.hpp"
#include "host/rt/lock_step/step_server.hpp"
#include "host/rtm/runtime/logging/logger.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "host/rtm/runtime/manager/probe_module.hpp"
#include "host/text/join.hpp"
#include "host/text/printable.hpp"
#include "shm/segment/dead_segments.hpp"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <thread>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

using tandem::options::RtmHostOptions;

// --plugin-path comes first.
std::vector<fs::path> plugin_path(const RtmHostOptions& a) {
    std::vector<fs::path> dirs = a.plugin_path;
    const auto more = tandem::plugin::default_plugin_dirs("rtm");
    dirs.insert(dirs.end(), more.begin(), more.end());
    return dirs;
}

// The arguments that the manager understands itself (configuration/command_line.hpp).
coil::vstring manager_arguments(const RtmHostOptions& a) {
    coil::vstring args{"rtm_host"};
    auto add = [&](const char* option, const std::string& value) {
        args.push_back(option);
        args.push_back(value);
    };
    if (!a.conf_file.empty()) add("-f", a.conf_file);
    for (const auto& setting : a.settings) add("-o", setting);
    if (!a.port.empty()) add("-p", a.port);
    if (a.master) args.push_back("-d");
    if (a.conf_file_may_be_missing) args.push_back("-i");
    if (a.no_corba_servant) args.push_back("-a");
    return args;
}

// Logs a step of the set-up that takes long. Ends the process if a signal has arrived and the step does not end in
// time. Until the main loop runs, nothing else handles the signal.
class StartupWatcher {
  public:
    StartupWatcher(RTC::Manager& manager, tandem::process::StepTimer& timer)
        : thread_(tandem::process::start_thread([this, &manager, &timer] { run(manager, timer); })) {}
    ~StartupWatcher() {
        done_ = true;
        thread_.join();
    }

  private:
    void run(RTC::Manager& manager, tandem::process::StepTimer& timer) {
        const auto grace = RTC::host_options().stop_timeout;
        auto requested_at = std::chrono::steady_clock::time_point::max();
        while (!done_) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            const auto now = std::chrono::steady_clock::now();
            const bool ending = RTC::Manager::terminationRequested();
            if (const std::string slow = timer.slow_step(); !slow.empty())
                tandem::log::warn("{}; {}", slow, ending ? "the host waits for it" : "Ctrl-C ends the host");
            if (!ending) continue;
            requested_at = std::min(requested_at, now);
            if (now - requested_at < grace) continue;
            tandem::log::error("{} does not return within {} s; exiting without waiting for it", timer.step(),
                               std::chrono::duration<double>(grace).count());
            RTC::end_during_set_up(manager);
            tandem::process::exit_process(1);
        }
    }
    std::atomic<bool> done_{false};
    std::thread thread_; // last, so that it sees done_ initialized
};

// A misspelt key of rtc.conf is only a warning. The host then looks healthy and does nothing. A master manager, in
// contrast, waits for tools that create components.
const char* ready_line(RTC::Manager& manager, const RtmHostOptions& a) {
    const bool master =
        a.master || coil::toBool(manager.getConfig().getProperty("manager.is_master"), "YES", "NO", false);
    if (master || !manager.getComponents().empty()) return "ready";
    return manager.getLoadedModules().empty() ? "ready, but nothing was loaded"
                                              : "ready, but no component was created";
}

// The RTCs and the program write to separate logs.
void flush_logs() {
    RTC::report_lost_log_lines();
    tandem::log::flush();
}

// Replaces this process by the same program with the same arguments. The process id stays the same, for the supervisor
// of the process. exec closes the descriptors (FD_CLOEXEC).
[[noreturn]] void restart(char** argv) {
    flush_logs();
    tandem::process::flush_streams();
    execv("/proc/self/exe", argv);
    tandem::log::print(std::string("rtm_host: cannot restart: ") + std::strerror(errno));
    tandem::process::exit_process(1);
}

// Limits the time of the static destructors of component libraries, which run after main().
void bound_static_destructors(RTC::Manager& manager) {
    const std::string libraries =
        tandem::text::join(manager.getLoadedModules(), " or ",
                           [](const auto& module) { return module.getProperty("module_file_path"); });
    if (libraries.empty()) return;
    tandem::process::set_exit_timeout(std::chrono::seconds(2),
                                      "rtm_host: " + tandem::text::printable_line(libraries) +
                                          ": static destructors do not return within 2 s; exiting without "
                                          "waiting for them");
}

// Runs the manager from its start to its end and returns the exit code. Throws std::runtime_error before the manager
// runs.
int run(const RtmHostOptions& a, char** argv_of_program) {
    for (const auto& notice : tandem::options::apply(a.real_time)) tandem::log::warn("{}", notice);
    RTC::Manager::Options options;
    options.lockstep = !a.lockstep_socket.empty();
    options.crash_report = "rtm_host";
    options.can_restart = true; // by restart() below
    options.cpu = a.real_time.cpu;
    options.tick_spin = a.real_time.tick_spin();
    options.plugin_path = plugin_path(a);
    options.probe = a.probe.probe_options();
    options.stop_timeout = a.grace();
    // Shared with the manager, which outlives this function.
    const auto timer = std::make_shared<tandem::process::StepTimer>("the start of the manager");
    options.on_setup_step = [timer](std::string step) { timer->begin(std::move(step)); };
    coil::Argv argv(manager_arguments(a));
    RTC::Manager& manager = RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    const tandem::process::ExitGuard exit_guard; // from here on components may call exit()
    try {
        {
            const StartupWatcher watcher(manager, *timer);
            manager.activateOrThrow();
        }
        std::unique_ptr<tandem::rt::StepServer> steps;
        if (options.lockstep)
            steps = std::make_unique<tandem::rt::StepServer>(
                a.lockstep_socket, [&](const std::string& name) { manager.step(name); });
        tandem::process::write_ready_line(ready_line(manager, a));
        std::fflush(stdout);
        manager.runManager();
        steps.reset(); // its thread ends before restart() replaces the process
        if (manager.restartRequested()) restart(argv_of_program);
    } catch (const std::runtime_error& e) {
        // Ends the components that already exist in order, so that they leave the hardware in a safe state.
        tandem::log::print("rtm_host: " + tandem::text::printable_line(e.what()));
        manager.shutdown();
        tandem::process::exit_process(1); // without static destructors: components may be half constructed
    }
    // Static destructors must not run while the thread of a callback that hangs uses static objects.
    if (const std::string hanging = RTC::left_behind(manager); !hanging.empty()) {
        tandem::log::error("exiting without waiting for {}", hanging);
        tandem::process::exit_process(1);
    }
    bound_static_destructors(manager);
    tandem::shm::remove_dead_segments();
    return 0;
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside of try only a mistake in the declaration of an option throws
int main(int argc, char** argv) {
    // In the child process of a module probe this does the probe and does not return.
    tandem::plugin::serve_probe(argc, argv, {{RTC::module_probe_task, RTC::run_module_probe}});
    tandem::log::hold_standard_streams();
    tandem::log::outlive_output_failures();
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // output of components precedes the error that it explains
    tandem::log::open("rtm_host");
    tandem::process::set_log_flush(flush_logs);
    // Installed before components are created, so that an early signal also ends the host cleanly.
    // runManager() keeps these handlers.
    for (int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int) { RTC::Manager::terminate(); });
    int exit_code = 0;
    const auto arguments = tandem::options::parse_rtm_host_options(argc, argv, exit_code);
    if (!arguments) return exit_code;
    tandem::shm::remove_dead_segments();
    try {
        const int code = run(*arguments, argv);
        tandem::process::flush_or_exit(code);
        return code;
    } catch (const std::runtime_error& e) {
        tandem::log::print("rtm_host: " + tandem::text::printable_line(e.what()));
        return 1;
    }
}
