// SPDX-License-Identifier: Apache-2.0
// rtm_host: runs the RT-Components that an rtc.conf names.
#include "host/plugin/probe_switches.hpp"
#include "host/process/exit_guard.hpp"
#include "host/process/exit_process.hpp"
#include "host/rt/step_server.hpp"
#include "host/rt/switches.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "host/rtm/runtime/manager/probe_module.hpp"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <tandem_version.hpp>
#include <thread>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string conf_file, port, lockstep;
    std::vector<std::string> settings;
    std::vector<fs::path> plugin_path;
    bool daemon = false, may_be_missing = false, no_servant = false;
    tandem::plugin::ProbeSwitches probe;
    tandem::rt::Switches switches;
};

void describe(CLI::App& app, Arguments& a) {
    app.add_option("-f", a.conf_file,
                   "configuration file (default: $RTC_MANAGER_CONFIG, ./rtc.conf, /etc/rtc.conf)");
    app.add_option("-o", a.settings, "a setting of rtc.conf, key:value; wins over the file (repeatable)")
        ->allow_extra_args(false);
    app.add_option("-p", a.port, "TCP port of the CORBA endpoint on the loopback interface");
    app.add_flag("-d", a.daemon, "run as master manager: do not leave without components");
    app.add_flag("-i", a.may_be_missing, "go on without the file of -f when there is none");
    app.add_flag("-a", a.no_servant, "the manager cannot be reached by CORBA");
    app.add_option("--lockstep", a.lockstep,
                   "unix socket: cycles run when a conductor asks there, not on timers");
    app.add_option("--plugin-path", a.plugin_path, "further folder of component libraries (repeatable)")
        ->allow_extra_args(false);
    tandem::plugin::declare(app, a.probe);
    tandem::rt::declare(app, a.switches);
}

// --plugin-path, $TANDEM_PLUGIN_PATH, then where build and installation put plugins.
std::vector<fs::path> plugin_path(const Arguments& a) {
    std::vector<fs::path> dirs = a.plugin_path;
    if (const char* path = std::getenv("TANDEM_PLUGIN_PATH"))
        for (const auto& dir : coil::split(path, ":", true)) dirs.emplace_back(dir);
    std::error_code none;
    const fs::path root = fs::read_symlink("/proc/self/exe", none).parent_path().parent_path();
    dirs.push_back(root / "plugins/rtm");
    for (const char* lib : {"lib", "lib64"}) dirs.push_back(root / lib / "tandem/plugins/rtm");
    for (const auto& entry : fs::directory_iterator(root / "lib", none)) // lib/x86_64-linux-gnu
        if (entry.is_directory() && fs::exists(entry.path() / "tandem/plugins/rtm"))
            dirs.push_back(entry.path() / "tandem/plugins/rtm");
    return dirs;
}

coil::vstring manager_arguments(const Arguments& a) {
    coil::vstring args{"rtm_host"};
    auto add = [&](const char* option, const std::string& value) {
        args.push_back(option);
        args.push_back(value);
    };
    if (!a.conf_file.empty()) add("-f", a.conf_file);
    for (const auto& setting : a.settings) add("-o", setting);
    if (!a.port.empty()) add("-p", a.port);
    if (a.daemon) args.push_back("-d");
    if (a.may_be_missing) args.push_back("-i");
    if (a.no_servant) args.push_back("-a");
    return args;
}

// While components are created a signal has to wait for them; not for ever, since one may hang.
class SignalWatch {
  public:
    explicit SignalWatch(RTC::Manager& manager) : thread_([this, &manager] { run(manager); }) {}
    ~SignalWatch() {
        done_ = true;
        thread_.join();
    }

  private:
    void run(RTC::Manager& manager) {
        constexpr auto patience = std::chrono::seconds(5);
        auto wanted_since = std::chrono::steady_clock::time_point::max();
        while (!done_) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            const auto now = std::chrono::steady_clock::now();
            if (!RTC::Manager::endWanted()) continue;
            wanted_since = std::min(wanted_since, now);
            if (now - wanted_since < patience) continue;
            spdlog::warn("a component does not let the host start; leaving without it");
            manager.shutdown();
            tandem::process::exit_process(0);
        }
    }
    std::atomic<bool> done_{false};
    std::thread thread_;
};

// The same program with the same arguments; what this process has opened is closed on the way.
[[noreturn]] void begin_anew(char** argv) {
    tandem::process::flush_streams();
    execv("/proc/self/exe", argv);
    std::fprintf(stderr, "rtm_host: cannot begin anew: %s\n", std::strerror(errno));
    tandem::process::exit_process(1);
}

// Static destructors of component libraries run after main().
void bound_static_destructors(RTC::Manager& manager) {
    std::string libraries;
    for (const auto& module : manager.getLoadedModules())
        libraries += (libraries.empty() ? "" : " or ") + module.getProperty("module_file_path");
    if (libraries.empty()) return;
    tandem::process::set_exit_timeout(
        std::chrono::seconds(2),
        "rtm_host: " + libraries +
            " does not come back from its static destructors within 2 s; the host ends "
            "without it");
}

int run(const Arguments& a, char** arguments) {
    for (const auto& notice : tandem::rt::apply(a.switches)) spdlog::warn("{}", notice);
    RTC::Manager::Options options;
    options.lockstep = !a.lockstep.empty();
    options.can_restart = true;
    options.cpu = a.switches.cpu;
    options.tick_spin = a.switches.tick_spin();
    options.plugin_path = plugin_path(a);
    options.probe = a.probe.probe();
    coil::Argv argv(manager_arguments(a));
    RTC::Manager& manager = RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    const tandem::process::ExitGuard exit_guard;
    bool all_ended = true;
    try {
        {
            SignalWatch watch(manager);
            manager.activateOrThrow();
        }
        std::unique_ptr<tandem::rt::StepServer> steps;
        if (options.lockstep)
            steps = std::make_unique<tandem::rt::StepServer>(
                a.lockstep, [&](const std::string& name) { manager.step(name); });
        std::puts("ready");
        std::fflush(stdout);
        manager.runManager();
        all_ended = manager.endedInOrder();
        steps.reset();
        if (manager.restartWanted()) begin_anew(arguments);
    } catch (const std::runtime_error& e) {
        std::fprintf(stderr, "rtm_host: %s\n", e.what());
        manager.shutdown();
        tandem::process::exit_process(
            1); // components may be half made: none of their static objects shall run now
    }
    if (!all_ended) {
        spdlog::warn("a component does not stop; leaving without it");
        tandem::process::exit_process(0);
    }
    bound_static_destructors(manager);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    tandem::plugin::serve_probe(argc, argv, {{RTC::module_probe_task, RTC::run_module_probe}});
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("rtm_host", std::make_shared<spdlog::sinks::stderr_sink_mt>()));
    std::signal(SIGPIPE, SIG_IGN);
    for (int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int) { RTC::Manager::terminate(); });
    CLI::App app{"Runs the RT-Components that an rtc.conf names."};
    Arguments arguments;
    app.set_version_flag("--version", std::string("rtm_host ") + tandem::version);
    describe(app, arguments);
    CLI11_PARSE(app, argc, argv);
    try {
        return run(arguments, argv);
    } catch (const std::runtime_error& e) {
        std::fprintf(stderr, "rtm_host: %s\n", e.what());
        return 1;
    }
}
