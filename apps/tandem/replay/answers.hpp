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

/// The recorded service calls and their results. [any-thread]
class Answers {
  public:
    /// Reads the whole recording and rewinds it.
    explicit Answers(Recording& recording);

    /// Returns the recorded answer for these arguments: the first unused one, or the last one if all are
    /// used. Returns CallStatus::not_ready with a message if none was recorded.
    link::Reply answer(const std::string& link, const link::Request& request);
    /// Returns the answer of the call with that number.
    const link::Reply* find(std::uint64_t call) const;

    /// Returns the operations of a port that the side called.
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
