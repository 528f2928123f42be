// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/rates.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::command {
namespace {

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

} // namespace

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

// Megabytes, not MiB, because people compare rates with networks and disks.
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

// Keys contain the units.
nlohmann::json to_json(const Rates& rates) {
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

} // namespace tandem::command
