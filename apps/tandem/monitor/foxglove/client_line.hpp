// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace tandem::monitor {

/// Sends answers to one client. Does nothing after its session has ended.
struct ClientLine {
    std::function<void(const nlohmann::json&)> send;
    std::function<void(std::string)> send_binary;

    /// Sends a status of the specification.
    void warn(const std::string& text) const { status(1, text); }
    void fail(const std::string& text) const { status(2, text); }

  private:
    void status(int level, const std::string& text) const {
        send({{"op", "status"}, {"level", level}, {"message", text}});
    }
};

} // namespace tandem::monitor
