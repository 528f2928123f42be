// SPDX-License-Identifier: Apache-2.0
// How the sub-commands of `tandem shm` call what they show, in text and in JSON.
#pragma once
#include "shm/inspect/observer.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tandem::command {

const char* to_string(shm::Readability readability);
const char* to_string(shm::PeerState state);

std::string format_side(const shm::ObservedSegment& segment, shm::Side side); ///< "alive, pid 123"
nlohmann::json to_json(const shm::ObservedSegment& segment);

/// The observation, or Error: there is no such link or generation.
shm::Observation observe_or_throw(const std::string& link, std::uint64_t generation);

/// For a segment that cannot be read: says so on stderr. Returns the exit code that follows.
int report_if_unreadable(const shm::ObservedSegment& segment);

} // namespace tandem::command
