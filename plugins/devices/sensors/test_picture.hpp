// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tandem::devices {

/// The size of a picture from the component's properties Width, Height and PixelBytes.
struct PictureSize {
    int width, height, pixel_bytes;
};

/// Draws a brightness gradient that moves to the left by 30 columns per second, so that lost or repeated pictures are
/// visible. `pixels` has room for width * height * pixel_bytes bytes.
inline void draw_test_picture(unsigned char* pixels, const PictureSize& size, double seconds) {
    const auto offset = static_cast<std::size_t>(seconds * 30);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < size.pixel_bytes; ++i)
                *pixels++ = static_cast<unsigned char>(static_cast<std::size_t>(x) + offset);
}

} // namespace tandem::devices
