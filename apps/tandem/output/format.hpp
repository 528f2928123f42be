// SPDX-License-Identifier: Apache-2.0
// Numbers and foreign text as all sub-commands of `tandem` show them.
#pragma once
#include <cstdint>
#include <string>
#include <sys/types.h>

namespace tandem::command {

/// Binary units, at most three digits: 640 B, 8.1 MiB, 512 KiB.
std::string format_bytes(std::uint64_t bytes);

/// A whole number in the unit that gives it two digits or more: 12 us, 3000 us, 41 s, 3 h.
std::string format_duration(std::uint64_t ns);

/// The time from `since_ns` (CLOCK_MONOTONIC, see shm::now_ns()) until now as a duration; "-" if it is 0 or in
/// the future, which a damaged segment may claim.
std::string format_age(std::uint64_t since_ns);

/// Login name of a user, or the number of one that has none.
std::string user_name(uid_t user);

/// Replaces bytes that are not printable ASCII by '?', so that a name read from shared memory cannot send
/// control sequences to the terminal.
std::string replace_nonprintable(const std::string& text);

/// Replaces control characters, newlines included, by '?'. UTF-8 text stays as it is.
std::string replace_control_characters(std::string text);

} // namespace tandem::command
