// SPDX-License-Identifier: Apache-2.0
// Formats numbers and untrusted text for all sub-commands of `tandem`.
#pragma once
#include <cstdint>
#include <string>
#include <sys/types.h>

namespace tandem::command {

/// Formats a size in binary units with at most three digits: 640 B, 8.1 MiB, 512 KiB.
std::string format_bytes(std::uint64_t bytes);

/// Formats a duration as a whole number, in a unit that gives at least two digits: 12 us, 3000 us, 41 s, 3 h.
std::string format_duration(std::uint64_t ns);

/// Formats the time since `since_ns` (CLOCK_MONOTONIC, see shm::now_ns()); "-" if `since_ns` is 0 or in the future, as
/// in a damaged segment.
std::string format_age(std::uint64_t since_ns);

/// Returns "pid 12", or "pid 7 of another namespace" if `elsewhere` is not 0: a process in a container has another pid
/// there, and an unrelated process may have this pid here.
std::string format_pid(std::uint32_t pid, std::uint32_t elsewhere);

/// Returns the login name of a user, or the user id if there is no name.
std::string user_name(uid_t user);

/// Replaces bytes other than printable ASCII by '?', so that a name from shared memory cannot send control sequences to
/// the terminal.
std::string replace_nonprintable(const std::string& text);

/// Replaces control characters, including newlines, by '?'. Leaves UTF-8 text unchanged.
std::string replace_control_characters(const std::string& text);

} // namespace tandem::command
