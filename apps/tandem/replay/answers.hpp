// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/replay/recording.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::command {

/// The recorded service calls, and what became of each. [any-thread]
class Answers {
  public:
    /// Reads the whole recording, and rewinds it.
    explicit Answers(Recording& recording);

    /// What the call was answered when it was recorded: of those with these arguments the first that was not given yet, else
    /// the last one. CallStatus::not_ready, with a line, if none was recorded.
    link::Reply answer(const std::string& link, const link::Request& request);
    /// Of the call of that number.
    const link::Reply* find(std::uint64_t call) const;

    /// The operations of a port that were called by that side.
    std::vector<link::ServiceOperation> operations(const std::string& link, const std::string& port,
                                                   shm::Side callers) const;

  private:
    struct Call {
        std::string link, port, operation, signature;
        shm::Side callers{};
        std::vector<std::byte> arguments;
        link::Reply reply;
        bool has_reply = false, given = false;
    };
    mutable std::mutex mutex_;
    std::map<std::uint64_t, Call> calls_; ///< by number
};

} // namespace tandem::command
