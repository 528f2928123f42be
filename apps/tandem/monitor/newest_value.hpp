// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/message_json.hpp"
#include "shm/inspect/ring_follower.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tandem::monitor {

/// The newest message of a port, decoded on request. Does not show long messages, because the page is for people. [one
/// thread]
// NOLINTNEXTLINE(bugprone-exception-escape): moving a nlohmann::json throws nothing
class NewestValue {
  public:
    static constexpr std::size_t max_message = 64 << 10; ///< limit in bytes for decoding a message
    static constexpr std::size_t max_text = 2000;        ///< limit in characters for showing all of the JSON

    /// Copies the message without decoding it.
    void keep(const command::FollowedPort& port, const shm::FollowedRecord& record);
    /// Returns whether decode() has something to decode.
    bool is_fresh() const { return fresh_; }
    /// Decodes the message kept since the last call.
    void decode(const command::FollowedPort& port);

    const nlohmann::ordered_json& value() const {
        return value_;
    }                                                 ///< null if there is none or it is too long
    const std::string& note() const { return note_; } ///< reason for no value, with the start of a long one

  private:
    std::vector<std::byte> bytes_;
    std::uint64_t stamp_ = 0;
    bool fresh_ = false;
    nlohmann::ordered_json value_;
    std::string note_;
};

} // namespace tandem::monitor
