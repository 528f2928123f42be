// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/options.hpp"

#include "host/options/number_check.hpp"
#include "host/options/usage_error.hpp"
#include "host/text/printable.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tandem_version.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace tandem::wheelchair {

namespace {

const std::map<std::string, Configuration> configurations{
    {"opros", Configuration::opros},     {"rtm", Configuration::rtm},     {"mixed", Configuration::mixed},
    {"swapped", Configuration::swapped}, {"split", Configuration::split}, {"memory", Configuration::memory}};

// Profiles and rtc.conf of a kept run contain these paths, and users can start the hosts from another folder.
std::string absolute(const std::string& path) {
    return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

/// These paths are written into profiles and rtc.conf, which have no way to write some of them.
void require_plain_path(const std::string& path) {
    const std::string shown = text::printable_line(path);
    if (shown == path && path.find('\\') == std::string::npos && !path.ends_with(' ')) return;
    std::fprintf(
        stderr,
        "wheelchair: %s has a control character, a backslash or a blank at its end, which the hosts' "
        "settings cannot contain; rename it\n",
        shown.c_str());
    std::exit(1);
}

/// Adds the options that are passed unchanged to both hosts (host/rt/README.md).
void add_host_options(CLI::App& app, Options& o, std::optional<double>& spin,
                      std::optional<std::string>& wait, bool& idle, bool& lock) {
    app.add_option("--opros-cpu", o.opros_cpu, "core for opros_host's tick threads");
    app.add_option("--rtm-cpu", o.rtm_cpu, "core for rtm_host's tick threads");
    app.add_option("--tick-spin", spin,
                   "both hosts poll for this time before each tick [us] (100 while messages flow)");
    app.add_option("--wait-mode", wait, "how both hosts wait for each other's calls (spin-then-futex)");
    app.add_flag("--low-latency-idle", idle, "both hosts keep the cores out of deep sleep states");
    app.add_flag("--lock-memory", lock, "both hosts lock their memory");
}

} // namespace

std::string name_of(Configuration configuration) {
    for (const auto& [name, value] : configurations)
        if (value == configuration) return name;
    return "?";
}

Options parse_options(int argc, char** argv) {
    Options o;
    std::optional<double> spin;
    std::optional<std::string> wait;
    bool idle = false, lock = false;
    std::string configuration = "mixed";
    CLI::App app{
        "Drives a simulated power wheelchair with components of two robot models: joystick, control and\n"
        "hardware as OPRoS components, as RT-Components, or mixed and joined through shared memory.",
        "wheelchair"};
    app.set_version_flag("--version", std::string("wheelchair ") + version);
    app.add_option("--config", configuration,
                   "opros, rtm, mixed (joystick an RTC), swapped (control and hardware RTCs), split "
                   "(control an RTC), or memory (no hosts; the expected result)")
        ->check(CLI::IsMember({"opros", "rtm", "mixed", "swapped", "split", "memory"}))
        ->capture_default_str();
    app.add_option("--scenario", o.scenario, "step20 (default), doorway, ...; a wrong name lists all");
    auto* joystick = app.add_option("--joystick", o.joystick_file,
                                    "recorded stick instead of the scenario's stick: CSV with t,jx,jy,estop");
    auto* lockstep =
        app.add_flag("--lockstep", o.lockstep,
                     "run in simulated time, one component after the other, with reproducible results");
    auto* record =
        app.add_option("--record", o.record, "record the links' messages to this file, for tandem replay")
            ->needs(lockstep);
    auto* drive =
        app.add_flag("--drive", o.drive,
                     "move the stick yourself, for an hour or --duration: with a gamepad, or on the\n"
                     "page of `tandem monitor --control`; Ctrl-C ends the drive, without a report;\n"
                     "the report covers the last minutes, 6 to 12")
            ->excludes(lockstep)
            ->excludes(joystick);
    app.add_flag(
           "--compare", o.compare,
           "run opros, rtm and mixed, and compare their steering angles; --plot draws them in one figure")
        ->excludes(record)
        ->excludes(drive);
    app.add_option("--duration", o.duration,
                   "seconds to drive, instead of the scenario's duration;\n"
                   "of more than 12 minutes in real time, report and log cover the last 6 to 12")
        ->check(options::number_between(0.01, 86400.0));
    app.add_option("--csv", o.csv, "write the log of every tick to this file")->take_last();
    app.add_option("--plot", o.plot, "plot to this file, .svg or .png")->take_last();
    app.add_option("--json", o.json, "write the results to this file")->take_last();
    app.add_option("--keep", o.keep, "write profiles, traces and logs to this folder and keep them");
    app.add_flag("--restart", o.restart, "restart a host that dies, in real time");
    app.add_option("--host-wait", o.host_wait, "time limit for a host to become ready, in seconds")
        ->check(options::number_between(0.1, 600.0))
        ->capture_default_str();
    app.add_option("--poll-us", o.poll_us,
                   "time for which ControlComp polls for a reference in each tick, in real time")
        ->check(options::number_between(0.0, 9000.0))
        ->capture_default_str();
    add_host_options(app, o, spin, wait, idle, lock);
    app.footer("Examples:\n  $ wheelchair --plot run.svg\n  $ wheelchair --config split --lockstep --record "
               "run.mcap");
    if (const auto exit_code = tandem::options::parse(app, argc, argv)) std::exit(*exit_code);
    o.configuration = configurations.at(configuration);
    if (o.drive && o.configuration == Configuration::memory) {
        std::fputs("wheelchair: --drive needs hosts; choose a --config other than memory\n", stderr);
        std::exit(1);
    }
    if (o.drive && o.duration == 0.0) o.duration = 3600.0;
    for (std::string* path : {&o.joystick_file, &o.csv, &o.plot, &o.json, &o.keep, &o.record})
        *path = absolute(*path);
    for (const std::string& path : {o.joystick_file, o.keep}) require_plain_path(path);
    // The hosts have options with the same names.
    if (spin) o.host_arguments.insert(o.host_arguments.end(), {"--tick-spin", fmt::format("{}", *spin)});
    if (wait) o.host_arguments.insert(o.host_arguments.end(), {"--wait-mode", *wait});
    if (idle) o.host_arguments.push_back("--low-latency-idle");
    if (lock) o.host_arguments.push_back("--lock-memory");
    return o;
}

} // namespace tandem::wheelchair
