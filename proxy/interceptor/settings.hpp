// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <coil/Properties.h>

#include <chrono>
#include <string>

namespace tandem::interceptor {

/// InterceptorComp's parameters, as given in rtc.conf: `InterceptorComp?link=NAME&rtc=INSTANCE`. docs/joining.md describes
/// them for users.
struct Settings {
    std::string link; ///< `link`: the name of the link, the same as AdaptorComp's
    std::string
        rtc; ///< `rtc`: instance names of the RTCs whose ports are shared, see enumerate_shared_ports()
    bool manage = false; ///< `manage`: whether the peer may use RtcManager and RtcConnector
    std::chrono::milliseconds call_timeout{1'000};    ///< `call_timeout` [ms]: of each call across the link
    std::size_t ring_bytes = std::size_t{256} * 1024; ///< `ring_kib`: of each data port
    std::size_t large_bytes = 0;                      ///< `large_kib`: longest message of a port
    std::size_t segment_bytes =
        std::size_t{4} * 1024 * 1024; ///< `segment_mib`: memory of each side, without chunks
    bool strict = false;              ///< `strict`: a port that cannot be shared is an error at set-up
    std::string group;                ///< `group`: may join the link, like the owner; empty: only the owner
};

/// Throws std::runtime_error, one line, if `link` is missing or another parameter has an invalid value.
Settings read_settings(coil::Properties& properties);

} // namespace tandem::interceptor
