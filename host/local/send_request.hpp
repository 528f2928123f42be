// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace tandem::local {

/// The process at the socket has ended, or belongs to another user.
struct NobodyListens : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Sends a request to the RequestServer at the socket. Returns its reply, or nothing if it has not come within `timeout`,
/// for example because the process is stopped and its queue of connections is full.
/// Throws NobodyListens, and std::runtime_error, one line, if the request is too long. [any-thread]
std::optional<std::string> send_request(const std::filesystem::path& socket, const std::string& request,
                                        std::chrono::milliseconds timeout);

} // namespace tandem::local
