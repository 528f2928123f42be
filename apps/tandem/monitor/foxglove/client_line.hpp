// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace tandem::monitor {

/// What the answers to one client go to; nothing happens once its session has ended.
struct ClientLine {
    std::function<void(const nlohmann::json&)> send;
    std::function<void(std::string)> send_binary;

    /// The specification's status.
    void warn(const std::string& text) const { status(1, text); }
    void fail(const std::string& text) const { status(2, text); }

  private:
    void status(int level, const std::string& text) const {
        send({{"op", "status"}, {"level", level}, {"message", text}});
    }
};

} // namespace tandem::monitor
