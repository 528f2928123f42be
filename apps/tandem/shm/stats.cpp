// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/shm_commands.hpp"
#include "apps/tandem/shm/shm_rates.hpp"
#include "apps/tandem/shm/shm_words.hpp"
#include "apps/tandem/text.hpp"
#include "shm/os/clock.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <thread>

namespace tandem::command {
namespace {

using shm::Side;

std::string headline(const shm::ObservedSegment& segment) {
    return fmt::format("{}: first {}; second {}\n", segment.path, side_text(segment, Side::first),
                       side_text(segment, Side::second));
}

constexpr double shares[] = {0.5, 0.9, 0.99, 0.999, 1};
constexpr const char* share_names[] = {"p50_ns", "p90_ns", "p99_ns", "p99_9_ns", "max_ns"};

std::string number(std::uint64_t value) { return std::to_string(value); }

std::string rings_text(const shm::Observation& seen) {
    Table table({"ring", "writer", ">sent", ">received", ">refused", ">overwritten", ">skipped", ">waiting",
                 ">bytes sent", ">bytes received"});
    for (const auto& ring : seen.rings) {
        const auto& c = ring.counters;
        if (ring.damage.empty())
            table.add({printable(ring.name), name_of(ring.writer), number(c.sent), number(c.received),
                       number(c.refused), number(c.overwritten), number(c.skipped), number(c.waiting()),
                       number(c.bytes_sent), number(c.bytes_received)});
        else
            table.add({printable(ring.name), "damaged"});
    }
    return table.empty() ? "" : table.text();
}

std::string call_queues_text(const shm::Observation& seen) {
    Table table({"call queue", "callers", ">calls", ">taken", ">answered", ">expired", ">overload",
                 ">time-out", ">cancelled", ">in use", ">slots"});
    for (const auto& queue : seen.call_queues) {
        const auto& c = queue.counters;
        if (queue.damage.empty())
            table.add({printable(queue.name), name_of(queue.callers), number(c.calls), number(c.taken),
                       number(c.answered), number(c.expired), number(c.overloads), number(c.timeouts),
                       number(c.cancels), number(c.in_use), number(queue.slots)});
        else
            table.add({printable(queue.name), "damaged"});
    }
    return table.empty() ? "" : table.text();
}

void add_times(Table& table, const std::string& of, shm::Side side, const char* what,
               const shm::HistogramCounts& times) {
    if (times.total() == 0) return;
    std::vector<std::string> row{printable(of), name_of(side), what, number(times.total())};
    for (const double share : shares) row.push_back(duration_text(times.percentile(share)));
    table.add(std::move(row));
}

std::string times_text(const shm::Observation& seen) {
    Table table({"time", "of", "what", ">samples", ">p50 <=", ">p90 <=", ">p99 <=", ">p99.9 <=", ">max <="});
    for (const auto& ring : seen.rings)
        if (ring.damage.empty()) add_times(table, ring.name, ring.writer, "age when read", ring.age);
    for (const auto& queue : seen.call_queues) {
        if (!queue.damage.empty()) continue;
        add_times(table, queue.name, queue.callers, "round trip", queue.round_trip);
        add_times(table, queue.name, other(queue.callers), "service", queue.service);
    }
    return table.empty() ? "" : table.text();
}

std::string text_of(const shm::Observation& seen) {
    if (seen.segment.readability != shm::Readability::readable) return "";
    std::string text = headline(seen.segment);
    for (const auto& part : {rings_text(seen), call_queues_text(seen), times_text(seen)})
        if (!part.empty()) text += "\n" + part;
    if (seen.rings.empty() && seen.call_queues.empty()) text += "no rings or call queues\n";
    for (const auto& damage : seen.damage) text += "damaged: " + damage + "\n";
    return text;
}

/// Percentiles are upper bounds; of no samples null.
nlohmann::json json_of(const shm::HistogramCounts& times) {
    nlohmann::json json{{"samples", times.total()}};
    for (std::size_t i = 0; i < std::size(shares); ++i)
        json[share_names[i]] =
            times.total() == 0 ? nlohmann::json() : nlohmann::json(times.percentile(shares[i]));
    return json;
}

nlohmann::json json_of(const shm::ObservedRing& ring) {
    const auto& c = ring.counters;
    if (!ring.damage.empty()) return {{"name", ring.name}, {"damage", ring.damage}};
    return {{"name", ring.name},
            {"writer", name_of(ring.writer)},
            {"sent", c.sent},
            {"received", c.received},
            {"dropped", {{"refused", c.refused}, {"overwritten", c.overwritten}, {"skipped", c.skipped}}},
            {"waiting", ring.counters.waiting()},
            {"bytes_sent", c.bytes_sent},
            {"bytes_received", c.bytes_received},
            {"age", json_of(ring.age)}};
}

nlohmann::json json_of(const shm::ObservedCallQueue& queue) {
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
            {"round_trip", json_of(queue.round_trip)},
            {"service", json_of(queue.service)}};
}

nlohmann::json json_of(const shm::Observation& seen) {
    nlohmann::json json{{"seen_ns", shm::now_ns()}, {"segment", to_json(seen.segment)}};
    if (seen.segment.readability != shm::Readability::readable) return json;
    json["rings"] = nlohmann::json::array();
    json["call_queues"] = nlohmann::json::array();
    for (const auto& ring : seen.rings) json["rings"].push_back(json_of(ring));
    for (const auto& queue : seen.call_queues) json["call_queues"].push_back(json_of(queue));
    json["damage"] = seen.damage;
    return json;
}

/// One look of --watch: what happened since the last look at the same segment.
void show_look(const StatsOptions& options, const std::optional<shm::Observation>& seen,
               const std::optional<Rates>& rates) {
    if (options.json) {
        nlohmann::json json =
            seen ? json_of(*seen) : nlohmann::json{{"seen_ns", shm::now_ns()}, {"segment", nullptr}};
        if (rates) json["rates"] = to_json(*rates);
        print_json(json, true);
        return;
    }
    if (!seen)
        print_text("link '" + options.link + "': no segment at the moment\n");
    else if (rates)
        print_text(headline(seen->segment) + to_text(*rates) + "\n");
    else
        print_text(text_of(*seen) + "\n");
    if (seen) report_readability(seen->segment);
}

int watch(const StatsOptions& options) {
    shm::check_link_name(options.link);
    const auto period = std::chrono::nanoseconds(static_cast<std::int64_t>(options.watch * 1e9));
    std::optional<shm::Observation> before;
    std::uint64_t before_ns = 0;
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t look = 1;; ++look) {
        auto seen = shm::observe(options.link, options.generation);
        const std::uint64_t now = shm::now_ns();
        std::optional<Rates> rates;
        if (before && seen) rates = rates_between(*before, *seen, now - before_ns);
        show_look(options, seen, rates);
        if (look == options.count) return 0;
        before = std::move(seen);
        before_ns = now;
        std::this_thread::sleep_until(next += period);
    }
}

} // namespace

int shm_stats(const StatsOptions& options) {
    if (options.watch > 0) return watch(options);
    const auto seen = observe_or_throw(options.link, options.generation);
    if (options.json)
        print_json(json_of(seen));
    else
        print_text(text_of(seen));
    return report_readability(seen.segment);
}

} // namespace tandem::command
