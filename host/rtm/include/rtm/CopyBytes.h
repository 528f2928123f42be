// SPDX-License-Identifier: Apache-2.0
// Ours: copies data that may be long.
#ifndef RTC_COPYBYTES_H
#define RTC_COPYBYTES_H
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace RTC {

/// Used by copyBytes() for 2 KiB and more.
inline void copyLong(void* to, const void* from, std::size_t length) {
    const std::size_t behind =
        (reinterpret_cast<std::uintptr_t>(to) - reinterpret_cast<std::uintptr_t>(from)) % 4096;
    if (behind == 0 || behind > 31) {
        std::memcpy(to, from, length);
        return;
    }
    struct Block {
        unsigned char bytes[64];
    } block;
    unsigned char* out = static_cast<unsigned char*>(to);
    const unsigned char* in = static_cast<const unsigned char*>(from);
    for (; length >= sizeof block; length -= sizeof block, out += sizeof block, in += sizeof block) {
        std::memcpy(&block, in, sizeof block);
        std::memcpy(out, &block, sizeof block);
    }
    if (length > 0) std::memcpy(out, in, length);
}

/// Copies like memcpy(), also 0 bytes. On AMD processors since Zen 3, memcpy() of glibc before 2.40 takes 18 times as
/// long, from 2 KiB to 1 MiB, if the destination is 1 to 31 bytes after the source modulo 4 KiB (glibc bug 30994).
/// Blocks whose size is a multiple of 4 KiB have such addresses if they are allocated one after the other.
inline void copyBytes(void* to, const void* from, std::size_t length) {
    if (length >= 2048)
        copyLong(to, from, length);
    else if (length > 0)
        std::memcpy(to, from, length);
}

} // namespace RTC
#endif
