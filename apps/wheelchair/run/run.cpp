// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/run.hpp"

#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/wheelchair/options.hpp"
#include "apps/wheelchair/run/chair_link.hpp"
#include "apps/wheelchair/run/run_directory.hpp"
#include "apps/wheelchair/run/step_recording.hpp"
#include "apps/wheelchair/run/topology.hpp"
#include "apps/wheelchair/run/trace_follower.hpp"
#include "host/rt/lock_step/step_client.hpp"
#include "host/text/printable.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"
#include "shm/segment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

namespace tandem::wheelchair {
namespace {

bool contains(const std::vector<RunComponent>& members, const std::string& name) {
    return std::any_of(members.begin(), members.end(), [&](const RunComponent& m) { return m.name == name; });
}

/// Runs the three components in simulated time. Requests their cycles one after the other, always in the same order
/// (docs/wheelchair.md, section 5.1), so that every run of a scenario gives the same bytes.
class LockstepDriver {
  public:
    /// Connects to the hosts of the run. Throws std::runtime_error if a host does not listen within 5 s.
    LockstepDriver(const RunDirectory& run, Configuration configuration) {
        for (const auto& host : run.hosts())
            hosts_[host.name] =
                std::make_unique<rt::StepClient>(run.step_socket(host.name), std::chrono::seconds(5));
        for (const char* component : {"JoystickComp", "ControlComp", "HWComp"}) {
            if (contains(opros_components(configuration), component))
                steps_.push_back({"opros_host", component});
            else
                // An RTC's instance name is its type and a number.
                steps_.push_back({"rtm_host", std::string(component) + "0"});
        }
    }

    /// Called after each cycle with the host's name and the component's instance name.
    using AfterStep = std::function<void(const std::string& host, const std::string& instance)>;

    /// Runs one cycle of JoystickComp, ControlComp and HWComp. Omits HWComp in the last tick, because its log row ends
    /// before HWComp. Throws std::runtime_error with the host's message.
    void run_tick(bool last, const AfterStep& after_step) {
        for (std::size_t i = 0; i + (last ? 1 : 0) < steps_.size(); ++i) {
            hosts_.at(steps_[i].host)->step(steps_[i].instance);
            if (after_step) after_step(steps_[i].host, steps_[i].instance);
        }
    }

  private:
    /// A cycle within a tick.
    struct Step {
        std::string host;
        std::string instance; // the component's name in that host
    };
    std::map<std::string, std::unique_ptr<rt::StepClient>> hosts_;
    std::vector<Step> steps_; // in the order of a tick
};

/// Shows a run's progress on standard error: on a terminal in one line that is rewritten, otherwise as a new line every
/// ten seconds. [one thread]
class Progress {
  public:
    /// `what` names the run
    explicit Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)) {
        // A shorter run shows no progress.
        next_ = monotonic_seconds() + (terminal_ ? 0.5 : 10.0);
    }

    /// clears the line
    ~Progress() { erase_line(); }
    /// Shows that `seconds` of `of` seconds are done, if an update is due.
    void show(double seconds, double of) {
        if (monotonic_seconds() < next_) return;
        erase_line();
        command::print_note("wheelchair: {}, {:.1f} of {:.1f} s{}", what_, seconds, of,
                            terminal_ ? "" : "\n");
        visible_ = terminal_;
        next_ = monotonic_seconds() + (terminal_ ? 0.2 : 10.0);
    }

    /// Prints a permanent line, after erasing the progress line from the terminal.
    void print_line(const std::string& line) {
        erase_line();
        command::print_note("wheelchair: {}\n", text::printable_line(line));
    }

  private:
    // Writes \r and the escape sequence that erases to the end of the line.
    void erase_line() {
        if (visible_) std::fputs("\r\033[K", stderr);
        visible_ = false;
        std::fflush(stderr);
    }

    std::string what_;
    bool terminal_, visible_ = false;
    double next_ = 0.0; // CLOCK_MONOTONIC [s] of the next update
};

using namespace std::chrono_literals;
using hosts::Host;
using hosts::Interrupted;
using hosts::Supervisor;

// --duration replaces the scenario's length.
Scenario scenario_of(const Options& options) {
    Scenario scenario = load_scenario(options.scenario, options.joystick_file);
    if (options.duration > 0.0) scenario.seconds = options.duration;
    return scenario;
}

/// A run with hosts. The order of the members matters: the hosts must end before the folder that they write to is
/// removed.
class HostedRun {
  public:
    HostedRun(const Options& options, Configuration configuration)
        : options_(options), configuration_(configuration), scenario_(scenario_of(options)),
          directory_(options, configuration, program_folder()),
          limit_(options.lockstep ? TraceLimit{} : limit_of_run(scenario_.seconds, !options.keep.empty())),
          traces_(directory_.traces(), limit_), progress_(name_of(configuration) + " " + scenario_.name) {}

    ~HostedRun() {
        if (!stopped_) stop_hosts(); // an exception is leaving execute()
    }

    RunResult execute() {
        if (!options_.record.empty()) recording_ = open_step_recording(options_.record);
        start_hosts();
        if (options_.lockstep)
            run_lockstep();
        else
            run_real_time();
        stop_hosts();
        if (recording_) std::fputs((recording_->close() + "\n").c_str(), stdout);
        return result();
    }

  private:
    // Prints the pids, because users need them to kill a host during the run.
    void start_hosts() {
        std::string pids;
        for (const auto& host : directory_.hosts()) {
            const Host& started = supervisor_.start(host);
            pids += fmt::format("{}{} pid {}", pids.empty() ? "" : ", ", host.name, started.process.pid());
        }
        std::fputs(fmt::format("{}: {}\n", name_of(configuration_), pids).c_str(), stdout);
        std::fflush(stdout);
        // AdaptorComp and InterceptorComp wait for each other before their hosts report ready, so with a link each host
        // may also need the other's time.
        supervisor_.wait_until_ready(options_.host_wait * (directory_.links().empty() ? 1.0 : 2.0));
    }

    // Simulated time: requests every cycle, as fast as the hosts answer.
    void run_lockstep() {
        LockstepDriver driver(directory_, configuration_);
        int tick = 0;
        LockstepDriver::AfterStep after_step;
        if (recording_) {
            begin_recording();
            after_step = [&](const std::string& host, const std::string& instance) {
                recording_->record_step(static_cast<std::uint64_t>(tick), host, instance);
            };
        }
        for (int n = 0; n <= scenario_.last_tick(); ++n) {
            try {
                tick = n;
                driver.run_tick(n == scenario_.last_tick(), after_step);
            } catch (const std::runtime_error& e) {
                // The socket closes before the process ends. Waits for its end, so that the message names the host.
                handle_events(supervisor_.watch(200ms));
                failures_.push_back(fmt::format("lock-step ended at tick {}: {}", n, e.what()));
                return;
            }
            if (n % 50 == 0)
                handle_events(
                    supervisor_.watch(0ms)); // checking in every tick would cost too many system calls
            if (n == 0 && component_missing()) return;
            progress_.show(n * tick_seconds, scenario_.seconds);
        }
    }

    void begin_recording() {
        std::vector<pid_t> pids;
        for (const Host& host : supervisor_.hosts()) pids.push_back(host.process.pid());
        recording_->begin(pids, std::chrono::nanoseconds(std::lround(tick_seconds * 1e9)));
    }

    // Real time: the components tick by themselves, and this program watches their traces and processes.
    void run_real_time() {
        // Ends in bounded time, even if HWComp's last ticks are never recorded.
        const double start = monotonic_seconds(), end = start + scenario_.seconds + 2.0;
        bool checked = false;
        show_chair();
        while (!finished() && monotonic_seconds() < end) {
            handle_events(supervisor_.watch(50ms));
            if (no_host_running()) return;
            traces_.update();
            check_long_run();
            if (chair_link_) chair_link_->update(traces_);
            report_consequences();
            progress_.show(scenario_time(), scenario_.seconds);
            if (!checked && monotonic_seconds() > start + 1.0) {
                checked = true;
                if (host_failures_.empty() && component_missing()) return;
            }
        }
    }

    /// Checks the references of a long run before their records are dropped, and keeps its first rows.
    void check_long_run() {
        if (limit_.records == 0) return;
        const std::size_t ticks = traces_.hw.dropped() + traces_.hw.records().size();
        if (ticks / limit_.records == checked_parts_) return;
        checked_parts_ = ticks / limit_.records;
        if (count_samples(traces_.joystick.records(), traces_.control.records()).lost != 0)
            lost_earlier_ = true;
        if (traces_.hw.dropped() > 0) return;
        constexpr std::size_t start_rows = 2000;
        start_ = merge(traces_.hw.records(), traces_.joystick.records(), traces_.control.records(),
                       scenario_.last_tick());
        start_.resize(std::min(start_.size(), start_rows));
        start_.shrink_to_fit();
    }

    /// Continues without the link if /dev/shm has no room for it.
    void show_chair() {
        try {
            chair_link_.emplace(directory_.chair_link(), options_.drive_socket);
        } catch (const shm::Error& e) {
            progress_.print_line(fmt::format("the chair is not visible to tandem monitor: {}", e.what()));
        }
    }

    /// Returns true and records a failure if a component has not ticked. Like the real engines, a host
    /// reports ready even if a component refused to start, so only the traces show it.
    bool component_missing() {
        traces_.update();
        std::string missing;
        if (traces_.joystick.records().empty()) missing = "JoystickComp";
        if (traces_.control.records().empty()) missing = "ControlComp";
        if (traces_.hw.records().empty()) missing = "HWComp";
        if (missing.empty()) return false;
        std::string errors;
        for (const Host& host : supervisor_.hosts())
            errors += fmt::format("; {}: {}", host.name, host.first_error());
        failures_.push_back(missing + " is not running" + errors);
        return true;
    }

    // HWComp's ticks are the scenario's clock. Returns 0 before the first tick.
    double scenario_time() const {
        const auto& hw = traces_.hw.records();
        return hw.empty() ? 0.0 : hw.back().sequence * tick_seconds;
    }

    bool finished() const {
        const auto& hw = traces_.hw.records();
        // One more tick than logged, so that ControlComp has used the last publication.
        return !hw.empty() && hw.back().sequence > scenario_.last_tick() + 1;
    }

    /// Without --restart the run continues while one host runs, because the user can start the other one by
    /// hand.
    bool no_host_running() {
        const auto& hosts = supervisor_.hosts();
        return std::none_of(hosts.begin(), hosts.end(),
                            [](const Host& h) { return h.running() || h.waits_for_restart(); });
    }

    void handle_events(const Supervisor::Events& events) {
        if (events.interrupted) throw Interrupted();
        for (Host* host : events.became_ready)
            for (HostFailure& failure : host_failures_)
                if (failure.host == host->name && failure.restarted_at == 0.0)
                    failure.restarted_at = host->ready_at;
        for (Host* host : events.ended) on_host_ended(*host);
        for (const Host* host : events.restarted) print_restart_of(*host);
        for (const auto& [host, reason] : events.failed_restarts)
            progress_.print_line(fmt::format("{} cannot be started again yet: {}", host->name, reason));
    }

    // Records and prints the failure; restarts the host with --restart. A lock-step run cannot continue,
    // because the components would start at tick 0.
    void on_host_ended(Host& host) {
        traces_.update();
        HostFailure i;
        i.host = host.name;
        i.pid = host.process.pid();
        i.exit_status = host.process.poll()->text();
        i.at = monotonic_seconds();
        i.run_time = scenario_time();
        const auto members =
            host.name == "opros_host" ? opros_components(configuration_) : rtm_components(configuration_);
        i.had_hw = std::any_of(members.begin(), members.end(),
                               [](const RunComponent& m) { return m.name == "HWComp"; });
        host_failures_.push_back(i);
        std::string line =
            fmt::format("{} (pid {}) {} at {:.2f} s", i.host, i.pid, i.exit_status, i.run_time);
        if (!host.process.poll()->signalled) line += "; its log: " + host.first_error();
        progress_.print_line(line +
                             (i.had_hw ? "; HWComp was running in it" : "; the other host keeps running"));
        if (options_.restart && !options_.lockstep) {
            const auto delay = supervisor_.restart(host);
            if (delay == 0ms) return; // without a wait
            progress_.print_line(
                fmt::format("{} ended soon after its start {} times in a row; it is started again in {:g} s",
                            host.name, host.quick_ends, std::chrono::duration<double>(delay).count()));
        } else if (!no_host_running()) {
            progress_.print_line("to restart it: " + host.command_line());
        }
    }

    void print_restart_of(const Host& host) {
        progress_.print_line(fmt::format("{} started again, pid {}", host.name, host.process.pid()));
    }

    // Prints each duration of a failure once, as soon as the traces contain it.
    void report_consequences() {
        for (HostFailure& i : host_failures_) {
            const bool had_stopped = i.motors_off_after_ms.has_value();
            if (!i.update(traces_.hw.records(), traces_.control.records())) continue;
            if (!had_stopped && i.motors_off_after_ms)
                progress_.print_line(
                    fmt::format("HWComp had both motor voltages at 0 {:.1f} ms after the last reference",
                                *i.motors_off_after_ms));
            if (i.data_back_after_ms)
                progress_.print_line(fmt::format(
                    "references reach ControlComp again {:.1f} ms after {}", *i.data_back_after_ms,
                    i.restarted_at > 0.0 ? i.host + " was ready" : i.host + " died"));
        }
    }

    /// Stops in start order, HWComp's host first, so that the motors are off before anything else stops.
    void stop_hosts() {
        stopped_ = true;
        for (Host& host : supervisor_.hosts()) {
            if (!host.running()) continue;
            const bool clean = supervisor_.stop(host);
            if (!clean)
                failures_.push_back(
                    fmt::format("{} (pid {}) did not stop cleanly: it {}{}{}", host.name, host.process.pid(),
                                host.process.poll() ? host.process.poll()->text() : "hangs",
                                host.first_error().empty() ? "" : "; its log: ", host.first_error()));
        }
        // A killed host leaves its segment in /dev/shm. No other process uses these links.
        for (const auto& [adaptor, link] : directory_.links()) shm::remove_dead(link);
    }

    // After a host failure, rows and references may be missing. Otherwise missing ones are failures.
    RunResult result() {
        traces_.update();
        report_consequences();
        RunResult r{
            configuration_, scenario_.name, scenario_.seconds, {}, {}, {}, host_failures_, failures_, {}};
        r.rows = merge(traces_.hw.records(), traces_.joystick.records(), traces_.control.records(),
                       scenario_.last_tick());
        if (traces_.hw.dropped() > 0) {
            r.seconds =
                scenario_.last_tick() * tick_seconds - traces_.hw.records().front().sequence * tick_seconds;
            r.start = start_;
        }
        r.samples = count_samples(traces_.joystick.records(), traces_.control.records());
        if (!options_.lockstep)
            r.latencies = latencies(traces_.joystick.records(), traces_.control.records());
        if (host_failures_.empty() && r.samples.lost != 0)
            r.failures.push_back(
                fmt::format("{} of {} references were lost", r.samples.lost, r.samples.sent));
        if (host_failures_.empty() && lost_earlier_ && r.samples.lost == 0)
            r.failures.push_back("references were lost before the last minutes, which the report covers");
        if (host_failures_.empty() && !r.rows.empty() && r.samples.received == 0)
            r.failures.push_back("no reference has reached ControlComp");
        if (host_failures_.empty() && !r.complete() && r.failures.empty())
            r.failures.push_back(
                fmt::format("only {} of {} ticks were recorded", r.rows.size(), scenario_.last_tick() + 1));
        return r;
    }

    const Options& options_;
    const Configuration configuration_;
    const Scenario scenario_;
    RunDirectory directory_;
    const TraceLimit limit_;
    ComponentTraces traces_;
    std::optional<ChairLink> chair_link_;
    Supervisor supervisor_;
    std::unique_ptr<StepRecording> recording_;
    Progress progress_;
    std::vector<HostFailure> host_failures_;
    std::vector<std::string> failures_;
    std::vector<Row> start_; // of a long run
    std::size_t checked_parts_ = 0;
    bool lost_earlier_ = false;
    bool stopped_ = false;
};

RunResult run_in_memory(const Options& options) {
    const Scenario scenario = scenario_of(options);
    RunResult r{
        Configuration::memory, scenario.name, scenario.seconds, simulate(scenario), {}, {}, {}, {}, {}};
    const long ticks = static_cast<long>(r.rows.size());
    r.samples = {ticks, ticks, 0};
    return r;
}

} // namespace

bool RunResult::complete() const {
    return static_cast<long>(rows.size()) == std::lround(seconds / tick_seconds) + 1;
}

RunResult run(const Options& options, Configuration configuration) {
    if (configuration == Configuration::memory) return run_in_memory(options);
    return HostedRun(options, configuration).execute();
}

} // namespace tandem::wheelchair
