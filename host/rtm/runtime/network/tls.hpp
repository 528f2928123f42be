// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace RTC {

/// Files in PEM: the certificates of those whom this process trusts, and its own key with its certificate. All empty: no TLS.
struct TlsFiles {
    std::string authority, key, password;
};

/// Loads omniORB's TLS transport, before ORB_init(), and returns the options of ORB_init() for it; none without files. A peer without a
/// certificate of that authority is refused. Throws std::runtime_error, one line, for a file that is missing.
std::vector<std::string> load_tls(const TlsFiles& files);

/// Whether load_tls() has loaded the transport: managers are then called by TLS. [any-thread]
bool uses_tls();

} // namespace RTC
