// SPDX-License-Identifier: Apache-2.0
// Format of `tandem rtm requests`: lengths (32 bits each) of a JSON object and of the bytes after it, then both.
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

namespace tandem::command {

/// A request or a reply. docs/monitoring.md does not describe them, because both ends are from one build.
struct Frame {
    nlohmann::json head;
    std::string bytes{}; ///< CDR, if any
};

/// Longer frames are errors of the other end.
inline constexpr std::size_t max_frame = 64 << 20;

inline std::string encode(const Frame& frame) {
    const std::string head = frame.head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const std::uint32_t lengths[] = {static_cast<std::uint32_t>(head.size()),
                                     static_cast<std::uint32_t>(frame.bytes.size())};
    std::string text(sizeof lengths, '\0');
    std::memcpy(text.data(), lengths, sizeof lengths);
    return text + head + frame.bytes;
}

/// Removes the first frame from `read`. Returns nullopt if it is incomplete. Throws std::runtime_error if it is
/// invalid.
inline std::optional<Frame> take_frame(std::string& read) {
    std::uint32_t lengths[2];
    if (read.size() < sizeof lengths) return std::nullopt;
    std::memcpy(lengths, read.data(), sizeof lengths);
    const std::size_t end = sizeof lengths + std::size_t{lengths[0]} + lengths[1];
    if (end > max_frame) throw std::runtime_error("a frame is larger than 64 MiB");
    if (read.size() < end) return std::nullopt;
    Frame frame{nlohmann::json::parse(read.begin() + sizeof lengths,
                                      read.begin() + sizeof lengths + lengths[0], nullptr, false),
                read.substr(sizeof lengths + lengths[0], lengths[1])};
    if (!frame.head.is_object()) throw std::runtime_error("a frame has no JSON object");
    read.erase(0, end);
    return frame;
}

} // namespace tandem::command
