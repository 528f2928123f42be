// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/type.hpp"

#include <optional>
#include <string>

namespace tandem::adaptor {

/// Returns the type if its values hold a RawImage, which the names of its members tell. Components carry a RawImage.h of
/// their own, whose load() makes room for width x height x pixelByte bytes and reads as many as `size` says.
std::optional<wire::Type> pictures_in(wire::Type type);

/// What the bytes of a picture are compared with width x height x pixelByte for.
enum class PictureBytes {
    exact,   ///< a component is to read it: `size` is the same number, too
    or_more, ///< a component has sent it: reset() to a smaller picture keeps the longer memory
};

/// Returns why the sizes and the bytes of a RawImage in the message contradict each other, in one line with the numbers;
/// empty if they do not. `message` is the type of the OPRoS value, without RTM's time. Allocates nothing then.
std::string picture_error(const wire::Type& message, wire::CdrReader in, PictureBytes bytes);

} // namespace tandem::adaptor
