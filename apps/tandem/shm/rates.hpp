// SPDX-License-Identifier: Apache-2.0
// What happened per second between two looks at one segment.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

struct RingRate {
    std::string name;
    shm::Side writer;
    double sent, received, dropped, bytes_sent; ///< per second
    std::uint64_t waiting;                      ///< now
};

struct CallQueueRate {
    std::string name;
    shm::Side callers;
    double calls, answered, failed; ///< per second; failed: overload, time-out or cancelled
    std::uint64_t in_use;           ///< now
};

struct Rates {
    std::vector<RingRate> rings;
    std::vector<CallQueueRate> call_queues;
};

/// Empty: the two looks are not at the same segment, or one was not readable.
std::optional<Rates> compute_rates(const shm::Observation& before, const shm::Observation& after,
                                   std::uint64_t elapsed_ns);

std::string format_rates(const Rates& rates);
nlohmann::json to_json(const Rates& rates);

} // namespace tandem::command
