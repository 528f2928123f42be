// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/report/acceptance.hpp"

#include "apps/bench/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tandem::bench {

namespace {

// The denominator of some ratios.
constexpr const char* ring_polling = "tandem/ring/one-way/64/spin";

/// The list under construction.
class Limits {
  public:
    using Comparison = AcceptanceLimit::Comparison;

    void at_most(const std::string& description, double limit, const std::string& numerator,
                 const std::string& denominator = {}) {
        list_.push_back({description, Comparison::at_most, limit, numerator, denominator});
    }
    void at_most_by_floor(const std::string& description, double near_limit, double far_limit,
                          const std::string& id) {
        at_most(description, far_limit, id);
        list_.back().near_limit = near_limit;
    }
    void stream_at_most(const std::string& description, double limit, const std::string& id) {
        at_most(description, limit, id);
        list_.back().near_floor_ns = 50;
    }
    void at_least(const std::string& description, double limit, const std::string& numerator,
                  const std::string& denominator = {}) {
        list_.push_back({description, Comparison::at_least, limit, numerator, denominator});
    }
    std::vector<AcceptanceLimit> take() { return std::move(list_); }

  private:
    std::vector<AcceptanceLimit> list_;
};

/// Tandem's ring with a sleeping reader, under the given conditions. On one core, the wait mode is
/// `same-core`, which yields before it sleeps.
std::string ring_asleep(const std::string& conditions, const std::string& operation = "one-way") {
    const bool same_core = conditions == "/same-core";
    return "tandem/ring/" + operation + "/64/" + (same_core ? "spin-then-futex" : "blocking") + conditions;
}

/// One 64-byte message. 48 bytes and their header fill one cache line, the least that a message can move.
void add_one_way(Limits& limits) {
    limits.at_most("one-way 48 B, polling / cache line", 1.15, "tandem/ring/paired/48/spin");
    limits.at_most("one-way 64 B, polling / minimal ring", 1.2, "tandem/ring/paired/64/spin");
    limits.at_least("iceoryx take / one-way 64 B, polling", 6, "peer/iceoryx/one-way/64/spin", ring_polling);
    limits.at_most("one-way 64 B, spin-then-futex, awake / minimal ring", 1.4,
                   "tandem/ring/paired/64/spin-then-futex");
    for (const std::string conditions : {"", "/low-latency-idle", "/same-core"})
        limits.at_most(fmt::format("one-way 64 B, asleep, {} / minimal ring",
                                   conditions.empty() ? "halted" : conditions.substr(1)),
                       1.05, ring_asleep(conditions, "paired"));
}

/// Every peer that can sleep, except under normal conditions: there, the wake-up of the halted core takes
/// most of the time, and all transports have similar times. 0.95, because on some guests the wake-up
/// dominates under all conditions.
void add_asleep_peers(Limits& limits, const std::vector<std::string>& ids) {
    for (const std::string conditions : {"low-latency-idle", "same-core"})
        for (const std::string& id : ids) {
            if (id.rfind("peer/", 0) != 0 || id.find("/paired/64/blocking") == std::string::npos ||
                !id.ends_with("/" + conditions))
                continue;
            const std::string peer = id.substr(5, id.find('/', 5) - 5);
            limits.at_least(fmt::format("{} asleep, {} / tandem", peer, conditions), 0.95, id);
        }
}

/// A call is a message each way and a slot that is claimed and freed.
void add_calls(Limits& limits) {
    limits.at_most("call, polling / pair of minimal rings", 1.5, "tandem/call-queue/paired/64/spin");
    limits.at_least("iceoryx client/server / call, polling", 5, "peer/iceoryx/call/64/spin",
                    "tandem/call-queue/call/64/spin");
}

/// The cache lines limit short messages: a message of 64 B with its header takes two, and one over the floor
/// takes one. Between two threads of one core, the instructions are the limit. The memory limits large
/// messages of all transports: 3 % is the noise of a run.
void add_streams(Limits& limits) {
    limits.stream_at_most("stream of 64 B / minimal ring", 2.2, "tandem/ring/paired-stream/64/spin");
    for (const std::string size : {"1M", "6M"}) {
        limits.at_most(size + "iB by loan / zero-copy baseline", 1.03,
                       "tandem/ring/paired-stream/" + size + "/spin/loan");
        limits.at_least(size + "iB by loan / iceoryx", 0.97, "tandem/ring/stream/" + size + "/spin/loan",
                        "peer/iceoryx/stream/" + size + "/spin/loan");
    }
    limits.at_most("1MiB by copy / copying baseline", 1.05, "tandem/ring/paired-stream/1M/spin/copy");
}

/// Across the bridge, including the work of both ports. The floor of the picture makes the same copies by
/// hand, into the shared memory and out of it, because each component has a separate picture. In the
/// event-driven cases, both components sleep.
void add_messages_across(Limits& limits, const std::string& direction) {
    const std::string bridge = "tandem/bridge/";
    limits.at_most_by_floor("component to component, " + direction + " / minimal ring", 2, 1.5,
                            bridge + "paired-one-way/64/spin/" + direction);
    for (const char* interval : {"1", "10", "100"})
        limits.at_most(fmt::format("one each {} ms, {} / minimal ring", interval, direction), 2.5,
                       fmt::format("{}paired-cold-{}ms/64/spin/{}", bridge, interval, direction));
    limits.at_most("string and 8 doubles, " + direction + ", ns", 800, bridge + "note/128/spin/" + direction);
    limits.at_most("1MiB image, " + direction + " / fill, copies and read", 1.1,
                   bridge + "paired-one-way/1M/spin/" + direction);
    for (const std::string conditions : {"", "/low-latency-idle"})
        limits.at_most(fmt::format("event-driven, asleep, {}, {} / minimal ring",
                                   conditions.empty() ? "halted" : conditions.substr(1), direction),
                       1.15, bridge + "paired-one-way/64/blocking/" + direction + conditions);
    limits.at_most_by_floor("component to component, " + direction + ", beside 63 links / minimal ring", 2,
                            1.5, bridge + "paired-64-links/64/spin/" + direction);
}

/// The ORB alone takes less than a call between two OpenRTM-aist processes. If both sides sleep, the wake-ups
/// take nearly all of the time, even with the ORB, so such calls are compared with sleeping minimal rings.
void add_calls_across(Limits& limits, const std::string& direction) {
    const std::string call = "tandem/bridge/call/16/", paired = "tandem/bridge/paired-call/16/";
    limits.at_most("call of 2 doubles, polling, " + direction + ", ns", 1500,
                   call + "spin-then-futex/" + direction);
    for (const std::string conditions : {"", "/low-latency-idle"})
        limits.at_most(fmt::format("call, asleep, {}, {} / pair of minimal rings",
                                   conditions.empty() ? "halted" : conditions.substr(1), direction),
                       1.3, paired + "blocking/" + direction + conditions);
    limits.at_least("omniORB, unix socket / call, polling, " + direction, 10,
                    "peer/omniorb-unix/call/64/blocking", call + "spin-then-futex/" + direction);
}

/// Links with many ports.
void add_components(Limits& limits) {
    for (const std::string direction : {"opros-to-rtm", "rtm-to-opros"}) {
        add_messages_across(limits, direction);
        add_calls_across(limits, direction);
    }
    limits.at_most("one-way, 256 ports open, one used / one port", 1.2,
                   "tandem/ring/paired-ports/64/spin/256 ports (1 used)");
    limits.at_most("one-way round 256 ports / one port", 1.2, "tandem/ring/paired-ports/64/spin/256 ports");
}

/// Inside opros_host. Most limits are absolute, because the hand-written counterparts (one mutex and a copy)
/// take equally long on most machines. An event wakes its receiver, which takes 4 us on one machine and 70 on
/// another.
void add_opros(Limits& limits) {
    limits.at_most("OPRoS push of a double, ns", 300, "tandem/opros/push/8");
    limits.at_most("OPRoS push of vector<double>(1000), ns", 1000, "tandem/opros/push/8000");
    limits.at_most("OPRoS blocking service call, ns", 200, "tandem/opros/local-call/8");
    limits.at_most("OPRoS event to call-back, low-latency-idle / minimal ring", 1.5,
                   "tandem/opros/event/8/blocking/low-latency-idle",
                   "baseline/index-ring/one-way/64/blocking/rested/low-latency-idle");
    limits.at_most("OPRoS 1 ms tick with tick-spin, late by ns", 1000, "tandem/opros/tick/8/spin");
    limits.at_most("OPRoS 1 ms tick / cyclictest", 1.5, "tandem/opros/tick/8/blocking",
                   "peer/cyclictest/tick/8/blocking");
}

/// Inside rtm_host.
void add_rtm(Limits& limits) {
    limits.at_most("RTM write of TimedLong, ns", 500, "tandem/rtm/write/12/direct");
    limits.at_most("RTM write of TimedDoubleSeq of 3, ns", 500, "tandem/rtm/write/36/direct");
    limits.at_most("RTM allocations per 100,000 writes and reads", 0,
                   "tandem/rtm/write-allocations/48/direct");
    limits.at_most("RTM service call, ns", 500, "tandem/rtm/local-call/8");
    limits.at_most("RTM 1 ms tick with tick-spin, late by ns", 1000, "tandem/rtm/tick/8/spin");
    limits.at_most("RTM 1 ms tick / cyclictest", 1.5, "tandem/rtm/tick/8/blocking",
                   "peer/cyclictest/tick/8/blocking");
}

/// While the reader is awake, publishing must not touch the kernel or the heap.
void add_publish_counts(Limits& limits) {
    for (const std::string wake : {"spin", "spin-then-futex"}) {
        limits.at_most("system calls per 100,000 publishes, " + wake, 0,
                       "tandem/ring/publish-system-calls/64/" + wake);
        limits.at_most("allocations per 100,000 publishes, " + wake, 0,
                       "tandem/ring/publish-allocations/64/" + wake);
    }
}

/// Returns the reason in the row of the case, or in the row of its peer: "peer/iceoryx" is the row of all its
/// cases.
std::string skip_reason(const Report& report, const std::string& id) {
    for (const Row& row : report.rows)
        if (!row.skipped.empty() && (row.id == id || id.rfind(row.id + "/", 0) == 0))
            return row.skipped +
                   (row.measured_again > 0 ? fmt::format("; {} times more as well", row.measured_again) : "");
    return "not measured: " + id;
}

/// Returns the ratio of each run, or the figure itself without a denominator; not finite if one of the two
/// failed. If only one of the two cases was measured again, because of another limit, the additional runs
/// have no ratio and are left out.
std::vector<double> values_of_runs(const Row& numerator, const Row* denominator) {
    std::vector<double> values = numerator.runs;
    if (denominator == nullptr) return values;
    values.resize(std::min(values.size(), denominator->runs.size()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] /= denominator->runs[i];
    return values;
}

/// Returns whether the case was tried and no run has a figure.
bool brought_nothing(const Report& report, const std::string& id) {
    return std::any_of(report.rows.begin(), report.rows.end(), [&](const Row& row) {
        return row.id == id && !row.runs.empty() && !row.skipped.empty();
    });
}

/// Skips the limit, with the reason, if one of the cases has no figures.
AcceptanceResult check_limit(const AcceptanceLimit& limit, const Report& report) {
    AcceptanceResult result{.limit = limit, .values = {}, .skipped = {}};
    const Row* numerator = report.find(limit.numerator);
    const Row* denominator = limit.denominator.empty() ? nullptr : report.find(limit.denominator);
    if (numerator == nullptr) {
        result.skipped = skip_reason(report, limit.numerator);
        return result;
    }
    if (denominator == nullptr && !limit.denominator.empty()) {
        result.skipped = skip_reason(report, limit.denominator);
        return result;
    }
    result.values = values_of_runs(*numerator, denominator);
    result.measured_again = denominator == nullptr
                                ? numerator->measured_again
                                : std::min(numerator->measured_again, denominator->measured_again);
    std::vector<double> values;
    std::copy_if(result.values.begin(), result.values.end(), std::back_inserter(values),
                 [](double value) { return std::isfinite(value); });
    if (values.empty()) {
        result.skipped = "no run has measured both cases";
        return result;
    }
    result.value = median(values);
    result.min = *std::min_element(values.begin(), values.end());
    result.max = *std::max_element(values.begin(), values.end());
    if (numerator->window_counts) result.limit.limit = limit.limit_at(numerator->window_counts->floor_ns);
    if (numerator->is_paired() && denominator == nullptr) {
        // Percentiles of the windows, because there are many more windows than runs.
        result.min = numerator->summary.p25;
        result.max = numerator->summary.p75;
    }
    return result;
}

} // namespace

bool AcceptanceLimit::is_met(double value) const {
    const double shown = std::round(value * 1000) / 1000;
    return comparison == Comparison::at_most ? shown <= limit : shown >= limit;
}

double AcceptanceLimit::limit_at(double floor_ns) const {
    if (floor_ns == 0) return limit; // a report of an earlier version does not have that time
    const double near_share =
        std::clamp((far_floor_ns - floor_ns) / (far_floor_ns - near_floor_ns), 0.0, 1.0);
    return (limit + near_share * (near_limit.value_or(limit) - limit)) *
           std::max(1.0, near_floor_ns / floor_ns);
}

std::vector<AcceptanceLimit> acceptance_limits(const std::vector<std::string>& ids) {
    Limits limits;
    add_one_way(limits);
    add_asleep_peers(limits, ids);
    add_calls(limits);
    add_streams(limits);
    add_components(limits);
    add_opros(limits);
    add_rtm(limits);
    add_publish_counts(limits);
    return limits.take();
}

std::string AcceptanceResult::verdict() const {
    if (!skipped.empty()) return "skipped: " + skipped;
    return (passed() ? "pass" : "FAIL") + (measured_again > 0 ? ", " + measurements_text(values) : "");
}

bool needed_for_acceptance(const std::vector<AcceptanceLimit>& limits, const std::string& id) {
    return std::any_of(limits.begin(), limits.end(), [&](const AcceptanceLimit& limit) {
        return limit.numerator == id || limit.denominator == id;
    });
}

bool is_accepted(const std::vector<AcceptanceResult>& results) {
    return std::any_of(results.begin(), results.end(), [](const auto& result) { return result.passed(); }) &&
           std::none_of(results.begin(), results.end(),
                        [](const auto& result) { return result.failed() || result.tried_in_vain; });
}

std::vector<AcceptanceResult> check_acceptance(const std::vector<AcceptanceLimit>& limits,
                                               const Report& report) {
    std::vector<AcceptanceResult> results;
    results.reserve(limits.size());
    for (const AcceptanceLimit& limit : limits) {
        results.push_back(check_limit(limit, report));
        for (const std::string& id : {limit.numerator, limit.denominator})
            if (id.starts_with("tandem/") && brought_nothing(report, id)) results.back().tried_in_vain = true;
    }
    return results;
}

std::vector<AcceptanceLimit> missed_limits(const std::vector<AcceptanceLimit>& limits, const Report& report) {
    std::vector<AcceptanceLimit> missed;
    for (const AcceptanceResult& result : check_acceptance(limits, report))
        if (result.failed() || brought_nothing(report, result.limit.numerator) ||
            brought_nothing(report, result.limit.denominator))
            missed.push_back(result.limit);
    return missed;
}

std::string acceptance_text(const std::vector<AcceptanceResult>& results) {
    std::string out = fmt::format("{:<58} {:>9} {:>19} {:>9}\n", "acceptance limits: median of the runs",
                                  "measured", "range", "limit");
    std::size_t passed = 0, failed = 0, again = 0;
    for (const AcceptanceResult& result : results) {
        const bool at_most = result.limit.comparison == AcceptanceLimit::Comparison::at_most;
        const std::string limit = fmt::format("{} {:.5g}", at_most ? "<=" : ">=", result.limit.limit);
        if (!result.skipped.empty()) {
            out += fmt::format("{:<58} {:>9} {:>19} {:>9}  {}\n", result.limit.description, "-", "-", limit,
                               result.verdict());
            continue;
        }
        ++(result.passed() ? passed : failed);
        again += result.measured_again > 0 ? 1 : 0;
        out += fmt::format("{:<58} {:>9.3f} {:>19} {:>9}  {}\n", result.limit.description, result.value,
                           fmt::format("{:.3f} .. {:.3f}", result.min, result.max), limit, result.verdict());
    }
    return out + fmt::format("{} pass, {} FAIL, {} skipped{}\n", passed, failed,
                             results.size() - passed - failed,
                             again > 0 ? fmt::format("; {} measured again", again) : "");
}

} // namespace tandem::bench
