// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"
#include "shm/inspect/call_follower.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace tandem::command {

/// Writes service calls to an MCAP file. Each operation has three channels: `/LINK/PORT/OPERATION/request`,
/// `.../reply`
/// and `.../failure`, whose messages begin with the number of the call. Arguments and results follow as
/// members, with the caller's types. [one thread]
class CallWriter {
  public:
    /// Returns the id of a schema of that name and IDL.
    using AddSchema = std::function<std::uint16_t(const std::string& name, const std::string& text)>;
    /// `writer` must outlive this object.
    CallWriter(mcap::McapWriter& writer, AddSchema add_schema)
        : writer_(writer), add_schema_(std::move(add_schema)) {}

    /// Times of a call in ns.
    struct Times {
        std::uint64_t call = 0; ///< publish time of the request
        std::uint64_t log = 0;  ///< log time of the request and the result
    };
    /// Writes a call and its result. Skips commands between the two proxies. Returns false if the request or reply is malformed
    /// or `wanted` rejects the port.
    bool write(const std::string& link, shm::Side callers, const shm::FollowedCall& call, const Times& times,
               const std::function<bool(const std::string& port)>& wanted);

    std::uint64_t calls() const { return calls_; }

  private:
    struct Channels {
        std::uint16_t request = 0, reply = 0, failure = 0;
    };
    using Key = std::tuple<std::string, std::string, std::string, std::string>;
    Channels add_channels(const Key& key, shm::Side callers);
    void write_message(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
                       std::span<const std::byte> payload);

    mcap::McapWriter& writer_;
    const AddSchema add_schema_;
    std::map<Key, Channels> channels_; ///< by link, port, operation and its signature
    std::vector<std::byte> message_;
    std::uint64_t calls_ = 0;
};

} // namespace tandem::command
