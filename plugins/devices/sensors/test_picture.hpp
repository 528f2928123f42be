// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tandem::devices {

/// The size of a picture, as components give it in the properties Width, Height and PixelBytes.
struct PictureSize {
    int width, height, bytes;
};

/// A slope of brightness that moves to the left with time.
inline void draw_test_picture(unsigned char* pixels, const PictureSize& size, double seconds) {
    const auto moved = static_cast<std::size_t>(seconds * 30);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < size.bytes; ++i)
                *pixels++ = static_cast<unsigned char>(static_cast<std::size_t>(x) + moved);
}

} // namespace tandem::devices
