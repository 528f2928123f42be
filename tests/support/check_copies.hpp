// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tandem::test {

/// Has `copy`, a function like memcpy(), copy several lengths to each place of the first 40 behind the source's, modulo 4 KiB.
template <class Copy>
void check_copies(const Copy& copy) {
    std::vector<unsigned char> from(8192), memory(4 * 4096 + from.size());
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<unsigned char>(i * 7);
    const std::size_t apart =
        (reinterpret_cast<std::uintptr_t>(from.data()) - reinterpret_cast<std::uintptr_t>(memory.data())) %
        4096;
    for (const std::size_t length : {0, 1, 63, 2047, 2048, 2049, 2111, 4096, 8191})
        for (std::size_t behind = 0; behind < 40; ++behind) {
            CAPTURE(length, behind);
            std::fill(memory.begin(), memory.end(), static_cast<unsigned char>(0xee));
            unsigned char* const to = memory.data() + 4096 + apart + behind;
            copy(to, from.data(), length);
            CHECK(std::equal(to, to + length, from.begin()));
            CHECK((to[-1] == 0xee && to[length] == 0xee));
        }
}

} // namespace tandem::test
