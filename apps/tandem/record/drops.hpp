// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "proxy/wire/cdr.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tandem::command {

/// Counts of messages of a port that the receiver or the recorder missed: a message of type `tandem::Drops`
/// in a recording.
struct Drops {
    std::uint64_t refused = 0, overwritten = 0, skipped = 0, not_recorded = 0;
    bool operator==(const Drops&) const = default;
};
inline constexpr const char* drops_type = "tandem::Drops";
inline constexpr const char* drops_idl =
    "module tandem {\nstruct Drops {\n  string port;\n  unsigned long long refused;\n"
    "  unsigned long long overwritten;\n  unsigned long long skipped;\n"
    "  unsigned long long not_recorded;\n};\n};\n";

inline std::vector<std::byte> encode(const std::string& port, const Drops& drops) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put_string(port);
    for (const std::uint64_t count : {drops.refused, drops.overwritten, drops.skipped, drops.not_recorded})
        out.put(count);
    return bytes;
}

} // namespace tandem::command
