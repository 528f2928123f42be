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

/// The newest message of a port, decoded when it is asked for. Long ones are not shown: the page is for people.
/// [one thread]
// NOLINTNEXTLINE(bugprone-exception-escape): moving a nlohmann::json throws nothing
class NewestValue {
  public:
    static constexpr std::size_t max_message = 64 << 10; ///< bytes of a message that is decoded
    static constexpr std::size_t max_text = 2000;        ///< characters of JSON that are shown whole

    /// Copies the message, not decoding it.
    void keep(const command::FollowedPort& port, const shm::FollowedRecord& record);
    /// Decodes what was kept since the last call.
    void decode(const command::FollowedPort& port);

    const nlohmann::ordered_json& value() const { return value_; } ///< null without one, or if it is too long
    const std::string& note() const { return note_; } ///< why there is no value, with the begin of a long one

  private:
    std::vector<std::byte> bytes_;
    std::uint64_t stamp_ = 0;
    bool fresh_ = false;
    nlohmann::ordered_json value_;
    std::string note_;
};

} // namespace tandem::monitor
