// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace RTC {

/// Files in PEM format: the certificates of trusted authorities, and the key of this process with its certificate. All
/// empty: no TLS.
struct TlsFiles {
    std::string authority, key, password;
};

/// Loads omniORB's TLS transport, before ORB_init(), and returns its options for ORB_init(); returns none if there are
/// no files. A peer without a certificate of the trusted authority is refused. Throws std::runtime_error, one line, for
/// a missing file.
std::vector<std::string> load_tls(const TlsFiles& files);

/// Returns whether load_tls() has loaded the transport. Managers are then called by TLS. [any-thread]
bool uses_tls();

} // namespace RTC
