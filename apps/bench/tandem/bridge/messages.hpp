// SPDX-License-Identifier: Apache-2.0
// The longer messages that carry the eight doubles of a ping.
#pragma once
#include "apps/bench/harness/payload.hpp"
#include "apps/bench/tandem/bridge/ping_message.hpp"

#include <cstddef>
#include <cstring>

namespace tandem::bench {

/// What a note of the case `note` says: longer than a std::string keeps without memory of its own.
constexpr const char* note_text = "a pose of the base, in metres and radians";

/// Bytes of the picture of the case `image`.
constexpr std::size_t image_bytes = std::size_t{1} << 20U;

/// The message, and behind it its number in all words. `memory`: image_bytes, aligned to 8.
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
