// SPDX-License-Identifier: Apache-2.0
// Counters per second between two observations of one segment.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// Of a ring; rates are per second, `waiting` is the number of records at the later observation.
struct RingRate {
    std::string name;
    shm::Side writer;
    double sent, received, dropped, bytes_sent;
    std::uint64_t waiting;
};

/// Of a call queue; `in_use` is the number of calls in progress at the later observation.
struct CallQueueRate {
    std::string name;
    shm::Side callers;
    double calls, answered, failed; ///< failed: overload, time-out or cancelled
    std::uint64_t in_use;
};

/// Only of objects that both observations contain: a ring that was added in between has no rate yet.
struct Rates {
    std::vector<RingRate> rings;
    std::vector<CallQueueRate> call_queues;
};

/// The rates of all objects that both observations contain undamaged. Empty if they are not of the same segment, or if
/// one of them could not be read. `elapsed_ns` is the time between them.
std::optional<Rates> compute_rates(const shm::Observation& before, const shm::Observation& after,
                                   std::uint64_t elapsed_ns);

/// Two tables, of rings and of call queues; "" without either.
std::string format_rates(const Rates& rates);
/// The member "rates" of `tandem shm stats --watch --json`.
nlohmann::json to_json(const Rates& rates);

} // namespace tandem::command
