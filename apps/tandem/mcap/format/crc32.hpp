// SPDX-License-Identifier: Apache-2.0
// CRC-32 as in zlib and IEEE 802.3. libdeflate computes it with the processor's carry-less multiplication.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <libdeflate.h>

namespace tandem::mcap {

/// Returns the CRC of `bytes`. `before`: CRC of the preceding bytes, which are then included.
inline std::uint32_t crc32(ByteView bytes, std::uint32_t before = 0) {
    // An empty view may contain a null pointer, for which libdeflate returns the initial value.
    return bytes.empty() ? before : libdeflate_crc32(before, bytes.data(), bytes.size());
}

} // namespace tandem::mcap
