// SPDX-License-Identifier: Apache-2.0
#pragma once
// The longer messages that carry the eight doubles of a ping.
#include "apps/bench/harness/payload.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tandem::bench {

/// [0] the sequence number; [1] BenchPing's clock at sending, [2] BenchPong's at receiving, [3] BenchPong's
/// at sending, each as the bits of a tick count; [4] not 0: from now on BenchPong sends once in each of its
/// ticks; [5] milliseconds that BenchPong then polls before it returns its thread; [6] in a case of tails:
/// the lateness of the tick that sends the message, in ns; the rest is payload.
using PingMessage = std::array<double, 8>;
constexpr std::size_t ping_sent_at = 1, pong_sent_at = 3; ///< its elements

inline double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
inline std::uint64_t as_bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// How long one onExecute() polls. Between two, the host has its thread and can stop the component.
constexpr double slice_ns = 20e6;

/// The text of a message of the case `note`: too long for the small-string buffer of std::string.
constexpr const char* note_text = "a pose of the base, in metres and radians";

/// Bytes of the picture of the case `image`.
constexpr std::size_t image_bytes = std::size_t{1} << 20U;

/// The message, followed by its number in all words. `memory`: image_bytes, aligned to 8.
inline void fill_image(void* memory, const PingMessage& message) {
    std::memcpy(memory, message.data(), sizeof message);
    fill_message(static_cast<std::byte*>(memory) + sizeof message, image_bytes - sizeof message,
                 static_cast<std::uint64_t>(message[0]));
}
/// Reads all of it. Throws std::runtime_error if its words do not agree.
inline void read_image(const void* memory, PingMessage& message) {
    std::memcpy(message.data(), memory, sizeof message);
    const auto number = checked_sequence(static_cast<const std::byte*>(memory) + sizeof message,
                                         image_bytes - sizeof message);
    if (number != static_cast<std::uint64_t>(message[0]))
        throw std::runtime_error("the picture is of another message");
}

} // namespace tandem::bench
