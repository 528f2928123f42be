// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace tandem::adaptor {

/// AdaptorComp's properties.
struct Settings {
    std::string link;                              ///< `link`: the name that InterceptorComp has, too
    std::chrono::milliseconds wait{10'000};        ///< `wait` [s]: how long the peer may take to come
    std::chrono::milliseconds call_timeout{1'000}; ///< `call_timeout` [ms]: of each call across the link
    std::size_t large_bytes = 0;                   ///< `large_kib`: longest message of a port, see README
    std::size_t segment_bytes = 4 * 1024 * 1024;   ///< `segment_mib`: that each half may lay out
};

/// Throws std::runtime_error, one line, when `link` is missing or a number is none.
Settings read_settings(const std::map<std::string, std::string>& properties);

} // namespace tandem::adaptor
