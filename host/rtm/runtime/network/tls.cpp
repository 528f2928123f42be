// SPDX-License-Identifier: Apache-2.0
// The transport is a library of omniORB. Processes without TLS load neither it nor OpenSSL.
#include "host/rtm/runtime/network/tls.hpp"
#include <atomic>
#include <boost/dll/shared_library.hpp>
#include <cerrno>
#include <cstring>
#include <omniORB4/CORBA.h>
#include <stdexcept>
#include <unistd.h>

namespace RTC {
namespace {

std::atomic<bool> tls_is_loaded{false};

void require_readable(const std::string& file, const char* what) {
    if (file.empty())
        throw std::runtime_error(std::string("TLS needs two files in PEM, and ") + what + " is not given");
    if (::access(file.c_str(), R_OK) != 0)
        throw std::runtime_error("TLS: " + file + ", " + what + ": " + std::strerror(errno));
}

} // namespace

std::vector<std::string> load_tls(const TlsFiles& files) {
    if (files.authority.empty() && files.key.empty()) return {};
    require_readable(files.authority, "the certificate of the authority");
    require_readable(files.key, "the key with its certificate");
    // Never unloaded, because omniORB keeps the objects that the library registers.
    static auto* const library = new boost::dll::shared_library;
    try {
        // Version 4.2.5 is 0x040205f1. The second number is also that of the libraries.
        const auto version = std::to_string((omniORB::versionHex() >> 16) & 0xff);
        library->load("libomnisslTP4.so." + version, boost::dll::load_mode::rtld_now |
                                                         boost::dll::load_mode::rtld_global |
                                                         boost::dll::load_mode::search_system_folders);
    } catch (const std::exception& error) {
        throw std::runtime_error(std::string("TLS: ") + error.what() +
                                 "; install omniORB with its TLS transport");
    }
    tls_is_loaded = true;
    return {"-ORBsslCAFile", files.authority, "-ORBsslKeyFile", files.key, "-ORBsslKeyPassword",
            files.password,
            // ms; everyone may begin a handshake, which occupies a thread
            "-ORBsslAcceptTimeOut", "2000"};
}

bool uses_tls() { return tls_is_loaded; }

} // namespace RTC
