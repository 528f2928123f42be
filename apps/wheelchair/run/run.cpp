// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/wheelchair/run/lockstep_driver.hpp"
#include "apps/wheelchair/run/progress.hpp"
#include "apps/wheelchair/run/run_directory.hpp"
#include "apps/wheelchair/run/supervisor.hpp"
#include "apps/wheelchair/run/topology.hpp"
#include "apps/wheelchair/run/trace_follower.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"

#include "shm/segment.hpp"

namespace tandem::wheelchair {

namespace {

using namespace std::chrono_literals;

Scenario scenario_of(const Options& options) {
    Scenario scenario = load_scenario(options.scenario, options.joystick_file);
    if (options.duration > 0.0) scenario.seconds = options.duration;
    return scenario;
}

/// One run with hosts. Members are destroyed in reverse: hosts first, then the folder they write into.
class HostedRun {
  public:
    HostedRun(const Options& options, Configuration configuration)
        : options_(options), configuration_(configuration), scenario_(scenario_of(options)),
          directory_(options, configuration, program_folder()), traces_(directory_.traces()),
          progress_(name_of(configuration) + " " + scenario_.name) {}

    ~HostedRun() {
        if (!stopped_) stop_hosts(); // an error is on its way up
    }

    RunResult drive() {
        start_hosts();
        if (options_.lockstep)
            run_lockstep();
        else
            run_real_time();
        stop_hosts();
        return result();
    }

  private:
    void start_hosts() {
        std::string pids;
        for (const auto& host : directory_.hosts()) {
            const Host& started = supervisor_.start(host.name, host.command, host.log);
            pids += fmt::format("{}{} pid {}", pids.empty() ? "" : ", ", host.name, started.process.pid());
        }
        fmt::print("{}: {}\n", name_of(configuration_), pids);
        std::fflush(stdout);
        // The halves of a link wait for each other before their hosts are ready.
        supervisor_.wait_until_ready(options_.host_wait * (directory_.links().empty() ? 1.0 : 2.0));
    }

    void run_lockstep() {
        LockstepDriver driver(directory_, configuration_);
        for (int n = 0; n <= scenario_.last_tick(); ++n) {
            try {
                driver.run_tick(n == scenario_.last_tick());
            } catch (const std::runtime_error& e) {
                handle_events(supervisor_.watch(200ms)); // says which host died, if one did
                failures_.push_back(fmt::format("lock-step ended at tick {}: {}", n, e.what()));
                return;
            }
            if (n % 50 == 0) handle_events(supervisor_.watch(0ms));
            if (n == 0 && component_missing()) return;
            progress_.show(n * tick_seconds, scenario_.seconds);
        }
    }

    void run_real_time() {
        // Bounded, whatever becomes of the hosts: the scenario and a little more.
        const double start = monotonic_seconds(), end = start + scenario_.seconds + 2.0;
        bool checked = false;
        while (!finished() && monotonic_seconds() < end) {
            handle_events(supervisor_.watch(50ms));
            if (no_host_running()) return;
            traces_.update();
            report_consequences();
            progress_.show(scenario_time(), scenario_.seconds);
            if (!checked && monotonic_seconds() > start + 1.0) {
                checked = true;
                if (host_failures_.empty() && component_missing()) return;
            }
        }
    }

    /// A host may be ready although a component refused to start, as the real engines are. True if one never
    /// ticked.
    bool component_missing() {
        traces_.update();
        std::string missing;
        if (traces_.joystick.records().empty()) missing = "JoystickComp";
        if (traces_.control.records().empty()) missing = "ControlComp";
        if (traces_.hw.records().empty()) missing = "HWComp";
        if (missing.empty()) return false;
        std::string words;
        for (const Host& host : supervisor_.hosts())
            words += fmt::format("; {}: {}", host.name, host.first_error());
        failures_.push_back(missing + " does not run" + words);
        return true;
    }

    double scenario_time() const {
        const auto& hw = traces_.hw.records();
        return hw.empty() ? 0.0 : hw.back().sequence * tick_seconds;
    }

    bool finished() const {
        const auto& hw = traces_.hw.records();
        // One tick more than logged, so that ControlComp has used the last publication.
        return !hw.empty() && hw.back().sequence > scenario_.last_tick() + 1;
    }

    /// Without --restart a dead host may come back by hand, but only while another one waits for it.
    bool no_host_running() {
        auto& hosts = supervisor_.hosts();
        return std::none_of(hosts.begin(), hosts.end(), [](const Host& h) { return h.running(); });
    }

    void handle_events(const Supervisor::Events& news) {
        if (news.interrupted) throw Interrupted();
        for (Host* host : news.became_ready)
            for (HostFailure& i : host_failures_)
                if (i.host == host->name && i.restarted_at == 0.0) i.restarted_at = host->ready_at;
        for (Host* host : news.ended) on_host_ended(*host);
    }

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
        if (!host.process.poll()->signalled) line += ", it said: " + host.first_error();
        progress_.print_line(line + (i.had_hw ? "; HWComp was in it" : "; the other host goes on"));
        if (options_.restart && !options_.lockstep) {
            supervisor_.restart(host);
            progress_.print_line(fmt::format("{} started again, pid {}", host.name, host.process.pid()));
        } else if (!no_host_running()) {
            progress_.print_line("to start it again: " + host.command_line());
        }
    }

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
                    "references reach ControlComp again, {:.1f} ms after {}", *i.data_back_after_ms,
                    i.restarted_at > 0.0 ? i.host + " was ready" : i.host + " died"));
        }
    }

    /// HWComp's host first, so that the motors are off before the joystick goes.
    void stop_hosts() {
        stopped_ = true;
        for (Host& host : supervisor_.hosts()) {
            if (!host.running()) continue;
            const bool clean = supervisor_.stop(host);
            if (!clean)
                failures_.push_back(
                    fmt::format("{} (pid {}) did not stop cleanly: it {}{}{}", host.name, host.process.pid(),
                                host.process.poll() ? host.process.poll()->text() : "hangs",
                                host.first_error().empty() ? "" : ", it said: ", host.first_error()));
        }
        for (const auto& [adaptor, link] : directory_.links()) shm::remove_dead(link);
    }

    RunResult result() {
        traces_.update();
        report_consequences();
        RunResult r{configuration_, scenario_.name, scenario_.seconds, {}, {}, {}, host_failures_, failures_};
        r.rows = merge(traces_.hw.records(), traces_.joystick.records(), traces_.control.records(),
                       scenario_.last_tick());
        r.samples = count_samples(traces_.joystick.records(), traces_.control.records());
        if (!options_.lockstep) r.latencies = latencies_us(traces_.control.records());
        if (host_failures_.empty() && r.samples.lost != 0)
            r.failures.push_back(
                fmt::format("{} of {} references were lost", r.samples.lost, r.samples.sent));
        if (host_failures_.empty() && !r.complete() && r.failures.empty())
            r.failures.push_back(
                fmt::format("only {} of {} ticks were recorded", r.rows.size(), scenario_.last_tick() + 1));
        return r;
    }

    const Options& options_;
    const Configuration configuration_;
    const Scenario scenario_;
    RunDirectory directory_;
    ComponentTraces traces_;
    Supervisor supervisor_;
    Progress progress_;
    std::vector<HostFailure> host_failures_;
    std::vector<std::string> failures_;
    bool stopped_ = false;
};

RunResult run_in_memory(const Options& options) {
    const Scenario scenario = scenario_of(options);
    RunResult r{Configuration::memory, scenario.name, scenario.seconds, simulate(scenario), {}, {}, {}, {}};
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
    return HostedRun(options, configuration).drive();
}

} // namespace tandem::wheelchair
