// SPDX-License-Identifier: Apache-2.0
// Segments as text and as JSON: what the sub-commands of `tandem shm` have in common.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tandem::command {

// The words that both the text and the JSON output use.
const char* to_string(shm::Readability readability);
const char* to_string(shm::PeerState state);

/// "alive, pid 123", "absent"; of a segment that cannot be read "held" or "-".
std::string format_side(const shm::ObservedSegment& segment, shm::Side side);

/// The header and both sides. Times are ages in ns, because CLOCK_MONOTONIC means nothing to a reader of the JSON.
/// Of a segment that cannot be read only what the file system tells, and the reason.
nlohmann::json to_json(const shm::ObservedSegment& segment);

/// Observes a generation of a link (0: the newest). Throws shm::Error if there is none.
shm::Observation observe_or_throw(const std::string& link, std::uint64_t generation);

/// For a segment that cannot be read prints the reason and a remedy to standard error. Returns the exit code: 0 if it
/// can be read, otherwise 1.
int report_if_unreadable(const shm::ObservedSegment& segment);

} // namespace tandem::command
