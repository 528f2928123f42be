// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/tick_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace tandem::monitor {
namespace {

constexpr std::uint64_t recent_ticks_ns = 5'000'000'000;

std::uint64_t octave_end(std::size_t octave) { return std::uint64_t{64} << octave; }

/// Returns the end of the octave that this share of the samples does not exceed.
std::uint64_t percentile_of(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& octaves,
                            std::uint64_t samples, double share) {
    std::uint64_t seen = 0;
    for (const auto& [end, count] : octaves) {
        seen += count;
        if (static_cast<double>(seen) >= std::ceil(share * static_cast<double>(samples))) return end;
    }
    return 0;
}

std::uint64_t more(std::uint64_t before, std::uint64_t now) { return now > before ? now - before : 0; }
std::uint64_t at_least_0(std::int64_t ns) { return ns > 0 ? static_cast<std::uint64_t>(ns) : 0; }

using Octaves = std::uint64_t[rt::TickSlot::octaves];

/// Returns the times that were counted between two reads. `longest_ns` is the longest time ever: an octave ends at up to
/// twice the measured value.
Times times_between(const Octaves& before, const Octaves& now, std::uint64_t longest_ns) {
    Times times;
    for (std::size_t i = 0; i < rt::TickSlot::octaves; ++i)
        if (const auto count = more(before[i], now[i]); count != 0) {
            times.octaves.emplace_back(octave_end(i), count);
            times.samples += count;
        }
    const auto percentile = [&](double share) {
        return std::min(percentile_of(times.octaves, times.samples, share), longest_ns);
    };
    times.p50_ns = percentile(0.5);
    times.p99_ns = percentile(0.99);
    times.max_ns = percentile(1);
    return times;
}

/// Returns whether it is a transition callback of an RTC, which the execution context runs within a cycle.
bool is_transition(const std::string& callback) {
    return callback == "onActivated" || callback == "onDeactivated" || callback == "onAborting" ||
           callback == "onReset";
}

/// Compares two reads without a tick in between, because a host that was stopped and continues is late for a moment.
std::optional<HangState> find_hang(const rt::TickSlot& before, const rt::TickSlot& now, std::uint64_t now_ns,
                                   std::uint64_t now_ms) {
    if (now.due_ns <= 0 || before.ticks != now.ticks || before.due_ns != now.due_ns) return {};
    const auto period_ns = static_cast<double>(now.period_ns);
    const double due_for_ns = static_cast<double>(now_ns) - static_cast<double>(now.due_ns);
    HangState hang{printable_text(now.callback.component), printable_text(now.callback.callback)};
    const double least_ns = is_transition(hang.callback) ? hanging_transition_ns : hanging_ns;
    if (due_for_ns < std::max(hanging_periods * period_ns, least_ns)) return {};
    if (hang.callback.empty()) hang.component.clear();
    const double age_ns = hang.callback.empty() ? due_for_ns : due_for_ns + period_ns;
    hang.seconds = age_ns / 1e9;
    hang.since_ms = now_ms - std::min(now_ms, static_cast<std::uint64_t>(age_ns / 1e6));
    return hang;
}

} // namespace

TickState TickReader::describe(const std::deque<Sample>& samples) const {
    const auto& [from_ns, before] = samples.front();
    const auto& [now_ns, now] = samples.back();
    TickState tick;
    tick.name = printable_text(now.name);
    tick.period_ns = now.period_ns;
    tick.ticks = now.ticks;
    tick.overruns = now.overruns;
    tick.skipped = now.skipped;
    tick.ticks_recently = more(before.ticks, now.ticks);
    std::copy(std::begin(now.lateness), std::end(now.lateness), tick.lateness.begin());
    std::copy(std::begin(now.execution), std::end(now.execution), tick.execution.begin());
    tick.overruns_recently = more(before.overruns, now.overruns);
    tick.latest_ns = at_least_0(now.lateness_ns_max);
    tick.longest_ns = at_least_0(now.execution_ns_max);
    if (now_ns > from_ns)
        tick.ticks_per_s =
            static_cast<double>(more(before.ticks, now.ticks)) * 1e9 / static_cast<double>(now_ns - from_ns);
    tick.recent_lateness = times_between(before.lateness, now.lateness, tick.latest_ns);
    tick.recent_execution = times_between(before.execution, now.execution, tick.longest_ns);
    return tick;
}

void TickReader::read_process(std::uint32_t pid, const std::string& program, State& state,
                              std::uint64_t now_ns) {
    Process& process = processes_[pid];
    if (now_ns >= process.next_look_ns) {
        process.next_look_ns = now_ns + file_search_pause_ns;
        process.pages = open_memory_files(pid, rt::TickPage::file_name, sizeof(rt::TickPage));
    }
    for (std::size_t page = 0; page < process.pages.size(); ++page) {
        const auto copy = read_memory_file<rt::TickPage>(process.pages[page]);
        if (!copy) continue;
        for (std::size_t slot = 0; slot < rt::TickPage::slots; ++slot) {
            const rt::TickSlot& now = copy->slot[slot];
            auto& samples = samples_[{pid, page, slot}];
            const bool same = !samples.empty() && samples.back().second.period_ns == now.period_ns &&
                              samples.back().second.ticks <= now.ticks &&
                              std::memcmp(samples.back().second.name, now.name, sizeof now.name) == 0;
            if (!same) samples.clear();
            if (now.period_ns == 0) continue;
            samples.emplace_back(now_ns, now);
            while (samples.size() > 2 && now_ns - samples[1].first >= recent_ticks_ns) samples.pop_front();
            TickState tick = describe(samples);
            if (samples.size() > 1)
                tick.hang = find_hang(samples[samples.size() - 2].second, now, now_ns, state.time_ms);
            tick.pid = pid;
            tick.slot = page * rt::TickPage::slots + slot;
            tick.program = program;
            state.ticks.push_back(std::move(tick));
        }
    }
}

void TickReader::read(State& state, std::uint64_t now_ns) {
    read_running_hosts(state, processes_, [&](std::uint32_t pid, const std::string& program) {
        read_process(pid, program, state, now_ns);
    });
    std::erase_if(samples_,
                  [&](const auto& sample) { return processes_.count(std::get<0>(sample.first)) == 0; });
}

} // namespace tandem::monitor
