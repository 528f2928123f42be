// SPDX-License-Identifier: Apache-2.0
// Times of recordings, in nanoseconds since 1970 or since another epoch of the recorder, such as the boot.
#pragma once
#include <cstdint>
#include <string>

namespace tandem::command {

/// Returns RFC 3339 in UTC with nanoseconds. Returns seconds for times before 1973, which probably have
/// another epoch.
std::string format_time(std::uint64_t ns);

/// Parses seconds after `begin` ("1.5"), or an RFC 3339 time ("2026-11-23T08:15:00.5Z", "...+09:00"). Throws
/// std::runtime_error with the name of `option` for any other text.
std::uint64_t parse_time(const std::string& text, std::uint64_t begin, const std::string& option);

} // namespace tandem::command
