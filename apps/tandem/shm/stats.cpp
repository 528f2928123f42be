// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/shm/segment_format.hpp"
#include "apps/tandem/shm/shm_commands.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/os/clock.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tandem::command {
namespace {

/// A ring's rates per second. `waiting`: number of records at the later observation.
struct RingRate {
    std::string name;
    shm::Side writer;
    double sent, received, dropped, bytes_sent;
    std::uint64_t waiting;
};

/// A call queue's rates per second. `in_use`: number of calls in progress at the later observation.
struct CallQueueRate {
    std::string name;
    shm::Side callers;
    double calls, answered, failed; ///< failed: overload, time-out or cancelled
    std::uint64_t in_use;
};

/// Contains only objects in both observations. A new ring has no rate yet.
struct Rates {
    std::vector<RingRate> rings;
    std::vector<CallQueueRate> call_queues;
};

/// Returns the object with this name and side in the previous observation; nullptr if there is none or either is
/// damaged. Names are unique only within a side.
template <class View>
const View* find_in(const std::vector<View>& before, const View& now) {
    const auto found = std::find_if(before.begin(), before.end(), [&](const View& view) {
        return view.name == now.name && view.owner == now.owner && view.damage.empty();
    });
    // The counters of a damaged object are meaningless.
    return found != before.end() && now.damage.empty() ? &*found : nullptr;
}

// Returns the number of calls without an answer, for any reason.
std::uint64_t failed(const shm::CallCounters& c) { return c.overloads + c.timeouts + c.cancels; }

// The generation does not suffice, because it restarts at 1 after a link was removed.
bool same_segment(const shm::ObservedSegment& a, const shm::ObservedSegment& b) {
    return a.readability == shm::Readability::readable && b.readability == shm::Readability::readable &&
           a.generation == b.generation && a.created_ns == b.created_ns;
}

/// Returns the rates of all objects that are undamaged in both observations. Returns nullopt for different or
/// unreadable segments. `elapsed_ns`: time between the observations.
std::optional<Rates> compute_rates(const shm::Observation& before, const shm::Observation& after,
                                   std::uint64_t elapsed_ns) {
    // Counters restart in a new segment, so the difference would be meaningless.
    if (!same_segment(before.segment, after.segment) || elapsed_ns == 0) return std::nullopt;
    // Signed, because a damaged counter can run backwards.
    const auto rate = [&](std::uint64_t from, std::uint64_t to) {
        return static_cast<double>(static_cast<std::int64_t>(to - from)) * 1e9 /
               static_cast<double>(elapsed_ns);
    };
    Rates rates;
    for (const auto& ring : after.rings)
        if (const auto* previous = find_in(before.rings, ring)) {
            const auto &a = previous->counters, &b = ring.counters;
            rates.rings.push_back({ring.name, ring.writer, rate(a.sent, b.sent), rate(a.received, b.received),
                                   rate(a.dropped(), b.dropped()), rate(a.bytes_sent, b.bytes_sent),
                                   ring.counters.waiting()});
        }
    for (const auto& queue : after.call_queues)
        if (const auto* previous = find_in(before.call_queues, queue)) {
            const auto &a = previous->counters, &b = queue.counters;
            rates.call_queues.push_back({queue.name, queue.callers, rate(a.calls, b.calls),
                                         rate(a.answered, b.answered), rate(failed(a), failed(b)), b.in_use});
        }
    return rates;
}

/// Returns a table of rings and one of call queues; "" if there are none.
/// Megabytes, not MiB, because people compare rates with networks and disks.
std::string format_rates(const Rates& rates) {
    // One decimal below 100, so that slow rings do not show as 0.
    const auto number = [](double value) { return fmt::format("{:.{}f}", value, value < 100 ? 1 : 0); };
    Table rings({"ring", "writer", ">sent/s", ">received/s", ">dropped/s", ">MB/s", ">waiting"});
    for (const auto& r : rates.rings)
        rings.add_row({replace_nonprintable(r.name), name_of(r.writer), number(r.sent), number(r.received),
                       number(r.dropped), fmt::format("{:.3f}", r.bytes_sent / 1e6),
                       std::to_string(r.waiting)});
    Table calls({"call queue", "callers", ">calls/s", ">answered/s", ">failed/s", ">in use"});
    for (const auto& c : rates.call_queues)
        calls.add_row({replace_nonprintable(c.name), name_of(c.callers), number(c.calls), number(c.answered),
                       number(c.failed), std::to_string(c.in_use)});
    return (rings.empty() ? "" : rings.text()) + (calls.empty() ? "" : calls.text());
}

/// Returns the member "rates" of `tandem shm stats --watch --json`.
/// Keys contain the units.
nlohmann::json rates_json(const Rates& rates) {
    auto rings = nlohmann::json::array(), calls = nlohmann::json::array();
    for (const auto& r : rates.rings)
        rings.push_back({{"name", r.name},
                         {"writer", name_of(r.writer)},
                         {"sent_per_s", r.sent},
                         {"received_per_s", r.received},
                         {"dropped_per_s", r.dropped},
                         {"bytes_sent_per_s", r.bytes_sent},
                         {"waiting", r.waiting}});
    for (const auto& c : rates.call_queues)
        calls.push_back({{"name", c.name},
                         {"callers", name_of(c.callers)},
                         {"calls_per_s", c.calls},
                         {"answered_per_s", c.answered},
                         {"failed_per_s", c.failed},
                         {"in_use", c.in_use}});
    return {{"rings", rings}, {"call_queues", calls}};
}

using shm::Side;

// Returns the line above the tables with the segment and its sides.
std::string format_headline(const shm::ObservedSegment& segment) {
    return fmt::format("{}: first {}; second {}\n", segment.path, format_side(segment, Side::first),
                       format_side(segment, Side::second));
}

// Percentiles in the tables, and their JSON keys.
constexpr double percentile_shares[] = {0.5, 0.9, 0.99, 0.999, 1};
constexpr const char* percentile_keys[] = {"p50_ns", "p90_ns", "p99_ns", "p99_9_ns", "max_ns"};

std::string cell(std::uint64_t value) { return std::to_string(value); }

// A damaged object keeps its line, so that users find it.
std::string format_rings(const shm::Observation& observation) {
    Table table({"ring", "writer", ">sent", ">received", ">refused", ">overwritten", ">skipped", ">waiting",
                 ">converted", ">undecodable", ">discarded", ">missed", ">bytes sent", ">bytes received"});
    for (const auto& ring : observation.rings) {
        const auto& c = ring.counters;
        if (ring.damage.empty())
            table.add_row({replace_nonprintable(ring.name), name_of(ring.writer), cell(c.sent),
                           cell(c.received), cell(c.refused), cell(c.overwritten), cell(c.skipped),
                           cell(c.waiting()), cell(c.converted), cell(c.undecodable), cell(c.discarded),
                           cell(c.missed_deadlines), cell(c.bytes_sent), cell(c.bytes_received)});
        else
            table.add_row({replace_nonprintable(ring.name), "damaged"});
    }
    return table.empty() ? "" : table.text();
}

// stats_help (shm_commands.cpp) explains the columns.
std::string format_call_queues(const shm::Observation& observation) {
    Table table({"call queue", "callers", ">calls", ">taken", ">answered", ">expired", ">overload",
                 ">time-out", ">cancelled", ">in use", ">slots"});
    for (const auto& queue : observation.call_queues) {
        const auto& c = queue.counters;
        if (queue.damage.empty())
            table.add_row({replace_nonprintable(queue.name), name_of(queue.callers), cell(c.calls),
                           cell(c.taken), cell(c.answered), cell(c.expired), cell(c.overloads),
                           cell(c.timeouts), cell(c.cancels), cell(c.in_use), cell(queue.slots)});
        else
            table.add_row({replace_nonprintable(queue.name), "damaged"});
    }
    return table.empty() ? "" : table.text();
}

const char* name_of(shm::CallStage stage) {
    if (stage == shm::CallStage::waiting) return "waiting";
    return stage == shm::CallStage::running ? "running" : "given up";
}

std::uint64_t age_of(const shm::ObservedCall& call) {
    const std::uint64_t now = shm::now_ns(); // the peer may have written any time
    return now > call.submitted_ns ? now - call.submitted_ns : 0;
}

// Formats calls in progress.
std::string format_open_calls(const shm::Observation& observation) {
    Table table({"open call", ">slot", "state", ">age", ">progress"});
    for (const auto& queue : observation.call_queues)
        for (const auto& call : queue.open_calls)
            table.add_row({replace_nonprintable(queue.name), cell(call.slot), name_of(call.stage),
                           format_duration(age_of(call)),
                           call.progress ? fmt::format("{:.1f} %", 100 * *call.progress) : "-"});
    return table.empty() ? "" : table.text();
}

nlohmann::json open_calls_json(const shm::ObservedCallQueue& queue) {
    auto calls = nlohmann::json::array();
    for (const auto& call : queue.open_calls)
        calls.push_back({{"slot", call.slot},
                         {"state", name_of(call.stage)},
                         {"age_ns", age_of(call)},
                         {"progress", call.progress ? nlohmann::json(*call.progress) : nlohmann::json()}});
    return calls;
}

// Adds a row of percentiles if there are samples.
void add_time_row(Table& table, const std::string& of, shm::Side side, const char* what,
                  const shm::HistogramCounts& times) {
    if (times.total() == 0) return;
    std::vector<std::string> row{replace_nonprintable(of), name_of(side), what, cell(times.total())};
    for (const double share : percentile_shares) row.push_back(format_duration(times.percentile(share)));
    table.add_row(std::move(row));
}

// Ages of records are measured at reading, round trips by the caller, and service times by the server.
std::string format_times(const shm::Observation& observation) {
    Table table({"time", "of", "what", ">samples", ">p50 <=", ">p90 <=", ">p99 <=", ">p99.9 <=", ">max <="});
    for (const auto& ring : observation.rings)
        if (ring.damage.empty()) add_time_row(table, ring.name, ring.writer, "age when read", ring.age);
    for (const auto& queue : observation.call_queues) {
        if (!queue.damage.empty()) continue;
        add_time_row(table, queue.name, queue.callers, "round trip", queue.round_trip);
        add_time_row(table, queue.name, other(queue.callers), "service", queue.service);
    }
    return table.empty() ? "" : table.text();
}

// Returns "" for an unreadable segment; report_if_unreadable() reports it.
std::string format_observation(const shm::Observation& observation) {
    if (observation.segment.readability != shm::Readability::readable) return "";
    std::string text = format_headline(observation.segment);
    for (const auto& part : {format_rings(observation), format_call_queues(observation),
                             format_open_calls(observation), format_times(observation)})
        if (!part.empty()) text += "\n" + part;
    if (observation.rings.empty() && observation.call_queues.empty()) text += "no rings or call queues\n";
    for (const auto& damage : observation.damage) text += "damaged: " + damage + "\n";
    return text;
}

/// Percentiles are upper ends of histogram buckets; null without samples.
nlohmann::json histogram_json(const shm::HistogramCounts& times) {
    nlohmann::json json{{"samples", times.total()}};
    for (std::size_t i = 0; i < std::size(percentile_shares); ++i)
        json[percentile_keys[i]] =
            times.total() == 0 ? nlohmann::json() : nlohmann::json(times.percentile(percentile_shares[i]));
    return json;
}

// sent = received + dropped + waiting is exact only at rest, because the counters are read one after the other.
nlohmann::json ring_json(const shm::ObservedRing& ring) {
    const auto& c = ring.counters;
    if (!ring.damage.empty()) return {{"name", ring.name}, {"damage", ring.damage}};
    return {{"name", ring.name},
            {"writer", name_of(ring.writer)},
            {"sent", c.sent},
            {"received", c.received},
            {"dropped", {{"refused", c.refused}, {"overwritten", c.overwritten}, {"skipped", c.skipped}}},
            {"waiting", ring.counters.waiting()},
            {"converted", c.converted},
            {"undecodable", c.undecodable},
            {"discarded", c.discarded},
            {"missed_deadlines", c.missed_deadlines},
            {"bytes_sent", c.bytes_sent},
            {"bytes_received", c.bytes_received},
            {"age", histogram_json(ring.age)}};
}

nlohmann::json call_queue_json(const shm::ObservedCallQueue& queue) {
    const auto& c = queue.counters;
    if (!queue.damage.empty()) return {{"name", queue.name}, {"damage", queue.damage}};
    return {{"name", queue.name},
            {"callers", name_of(queue.callers)},
            {"calls", c.calls},
            {"taken", c.taken},
            {"answered", c.answered},
            {"expired", c.expired},
            {"overloads", c.overloads},
            {"timeouts", c.timeouts},
            {"cancels", c.cancels},
            {"in_use", c.in_use},
            {"slots", queue.slots},
            {"worker_wakes", c.worker_wakes},
            {"caller_wakes", c.caller_wakes},
            {"open_calls", open_calls_json(queue)},
            {"round_trip", histogram_json(queue.round_trip)},
            {"service", histogram_json(queue.service)}};
}

// observed_ns is CLOCK_MONOTONIC, so that readers can compute rates from several lines.
nlohmann::json observation_json(const shm::Observation& observation) {
    nlohmann::json json{{"observed_ns", shm::now_ns()}, {"segment", to_json(observation.segment)}};
    if (observation.segment.readability != shm::Readability::readable) return json;
    json["rings"] = nlohmann::json::array();
    json["call_queues"] = nlohmann::json::array();
    for (const auto& ring : observation.rings) json["rings"].push_back(ring_json(ring));
    for (const auto& queue : observation.call_queues) json["call_queues"].push_back(call_queue_json(queue));
    json["damage"] = observation.damage;
    return json;
}

/// Prints one observation of --watch: the rates, or the counters if there are no rates (the first time, or after a new
/// generation). A missing segment is not an error, because the hosts may be restarting.
void print_observation(const StatsOptions& options, const std::optional<shm::Observation>& observation,
                       const std::optional<Rates>& rates) {
    if (options.json) {
        nlohmann::json json = observation
                                  ? observation_json(*observation)
                                  : nlohmann::json{{"observed_ns", shm::now_ns()}, {"segment", nullptr}};
        // In addition to the counters, so that a program can use either.
        if (rates) json["rates"] = rates_json(*rates);
        print_json(json, true);
        return;
    }
    if (!observation)
        print_text("link '" + options.link + "': no segment exists now\n");
    else if (rates)
        print_text(format_headline(observation->segment) + format_rates(*rates) + "\n");
    else
        print_text(format_observation(*observation) + "\n");
    // The exit code is only for a single observation; a watch continues.
    if (observation) report_if_unreadable(observation->segment);
}

// Observes at once, then sleeps until absolute times, so that the duration of an observation does not extend the
// period.
int watch_segment(const StatsOptions& options) {
    shm::check_link_name(options.link);
    const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(options.period_s * 1e9));
    std::optional<shm::Observation> previous;
    std::uint64_t previous_ns = 0;
    auto next = std::chrono::steady_clock::now();
    // count 0 never equals the iteration, so only a signal ends the loop.
    for (std::uint64_t iteration = 1;; ++iteration) {
        auto observation = shm::observe(options.link, options.generation);
        const std::uint64_t now = shm::now_ns();
        std::optional<Rates> rates;
        // Each iteration looks up the newest generation. The first observation of a new one has counters but no rates.
        if (previous && observation) rates = compute_rates(*previous, *observation, now - previous_ns);
        print_observation(options, observation, rates);
        if (iteration == options.count) return 0;
        previous = std::move(observation);
        previous_ns = now;
        std::this_thread::sleep_until(next += period);
    }
}

} // namespace

int shm_stats(const StatsOptions& options) {
    if (options.period_s > 0) return watch_segment(options);
    const auto observation = observe_or_throw(options.link, options.generation);
    if (options.json)
        print_json(observation_json(observation));
    else
        print_text(format_observation(observation));
    return report_if_unreadable(observation.segment);
}

} // namespace tandem::command
