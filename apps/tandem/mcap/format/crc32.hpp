// SPDX-License-Identifier: Apache-2.0
// CRC-32 as zlib and IEEE 802.3 have it, by libdeflate, which uses the processor's carry-less multiplication.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <libdeflate.h>

namespace tandem::mcap {

/// The CRC of `bytes`, or, with the CRC of what comes before them, of both.
inline std::uint32_t crc32(ByteView bytes, std::uint32_t before = 0) {
    // Without bytes the pointer may be null, which libdeflate takes for a question for its initial value.
    return bytes.empty() ? before : libdeflate_crc32(before, bytes.data(), bytes.size());
}

} // namespace tandem::mcap
