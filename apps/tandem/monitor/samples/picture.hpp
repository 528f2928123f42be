// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/wire/type.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tandem::monitor {

/// A picture in a message. `pixels` points into the message.
struct Picture {
    std::int64_t width = 0, height = 0;
    std::string format; ///< as the sender calls it; empty: OPRoS's RawImage has none
    std::span<const std::byte> pixels;
};

/// Returns whether messages of the type are pictures: RTC::CameraImage, OPRoS's RawImage, or another structure with the
/// integers `width` and `height` and one list of octets.
bool is_picture(const wire::Type& message);

/// Returns the picture in a message of a type for which is_picture() is true; nullopt if the bytes are not such a message.
std::optional<Picture> picture_in(const wire::Type& message, std::span<const std::byte> bytes);

} // namespace tandem::monitor
