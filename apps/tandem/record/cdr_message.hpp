// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tandem::command {

/// The header of a message in a recording: CDR, little endian (OMG DDSI-RTPS 2.5, section 10.2.1.2).
inline constexpr std::byte encapsulation[4] = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};

/// Channels of `tandem record` other than ports: their topics, and the value of `tandem.kind` in their
/// metadata.
inline constexpr const char *steps_topic = "/tandem/steps", *clock_topic = "/tandem/clock";
inline constexpr const char *request_kind = "request", *reply_kind = "reply", *failure_kind = "failure";

/// Returns CLOCK_REALTIME in ns.
inline std::uint64_t wall_clock_ns() {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000ULL +
           static_cast<std::uint64_t>(now.tv_nsec);
}

/// Returns the CDR of a payload from outside. Throws std::runtime_error if it is not little-endian CDR.
inline std::string behind_encapsulation(std::string_view payload) {
    if (payload.size() < sizeof encapsulation || std::memcmp(payload.data(), encapsulation, 2) != 0)
        throw std::runtime_error("expected little-endian CDR with its encapsulation, 00 01 00 00");
    return std::string(payload.substr(sizeof encapsulation));
}

inline std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

} // namespace tandem::command
