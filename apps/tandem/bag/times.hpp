// SPDX-License-Identifier: Apache-2.0
// Times of recordings, in nanoseconds since 1970 (or since another epoch that the recorder chose, as the boot).
#pragma once
#include <cstdint>
#include <string>

namespace tandem::command {

/// RFC 3339 in UTC with nanoseconds; of a time before 1973, which is hardly one since 1970, the seconds.
std::string format_time(std::uint64_t ns);

/// Seconds ("1.5") after `begin`, or a time by RFC 3339 ("2026-11-23T08:15:00.5Z", "...+09:00"). Throws
/// std::runtime_error that names `option` for anything else.
std::uint64_t parse_time(const std::string& text, std::uint64_t begin, const std::string& option);

} // namespace tandem::command
