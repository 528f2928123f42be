// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <optional>
#include <string>

namespace tandem::adaptor {

/// Returns the type if its values contain a RawImage, recognized by the names of its members. Components bring their own
/// RawImage.h, whose load() allocates width x height x pixelByte bytes and reads as many as `size` states.
std::optional<wire::Type> pictures_in(wire::Type type);

/// How the number of bytes of a picture must compare with width x height x pixelByte.
enum class PictureBytes {
    exact,   ///< a component will read it, so `size` must also be that number
    or_more, ///< a component has sent it: reset() to a smaller picture keeps the longer memory
};

/// Returns why the sizes and the bytes of a RawImage in the message contradict each other, in one line with the numbers;
/// empty, without an allocation, if they do not. `message` is the type of the OPRoS value, without RTM's time.
std::string picture_error(const wire::Type& message, wire::CdrReader in, PictureBytes bytes);

} // namespace tandem::adaptor
