// SPDX-License-Identifier: Apache-2.0
// Computes rates of counters between two observations of a segment.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

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

/// Returns the rates of all objects that are undamaged in both observations. Returns nullopt for different or
/// unreadable segments. `elapsed_ns`: time between the observations.
std::optional<Rates> compute_rates(const shm::Observation& before, const shm::Observation& after,
                                   std::uint64_t elapsed_ns);

/// Returns a table of rings and one of call queues; "" if there are none.
std::string format_rates(const Rates& rates);
/// Returns the member "rates" of `tandem shm stats --watch --json`.
nlohmann::json to_json(const Rates& rates);

} // namespace tandem::command
