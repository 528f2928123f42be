// SPDX-License-Identifier: Apache-2.0
// Segments as text and as JSON, for all sub-commands of `tandem shm`.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tandem::command {

// The words of the text and the JSON output.
const char* to_string(shm::Readability readability);
const char* to_string(shm::PeerState state);

/// Returns for example "alive, pid 123", "alive, pid 7 of another namespace" or "absent"; for an unreadable segment "held" or "-".
std::string format_side(const shm::ObservedSegment& segment, shm::Side side);

/// Returns the header and both sides. Times are ages in ns, because CLOCK_MONOTONIC is meaningless to a reader of the
/// JSON. For an unreadable segment, returns only the file system's data and the reason.
nlohmann::json to_json(const shm::ObservedSegment& segment);

/// Returns a line about files of other users that shm::observe_segments() has left out; "" if there are none.
std::string format_left_out(std::size_t files);

/// Observes a generation of a link (0: the newest). Throws shm::Error if it does not exist.
shm::Observation observe_or_throw(const std::string& link, std::uint64_t generation);

/// For an unreadable segment, prints the reason and a remedy to standard error. Returns the exit code: 0 if it is
/// readable, otherwise 1.
int report_if_unreadable(const shm::ObservedSegment& segment);

} // namespace tandem::command
