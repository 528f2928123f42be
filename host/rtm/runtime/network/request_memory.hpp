// SPDX-License-Identifier: Apache-2.0
// The memory of large requests that are arriving.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace RTC {

/// What one request has taken.
struct TakenMemory {
    std::pair<const std::string, std::size_t>* client = nullptr; ///< an entry of RequestMemory
    std::size_t bytes = 0;
};

/// Bounds the bytes that arrive at the same time: `of_client` bytes for each client, `of_all` for all. A request whose
/// size is not known before its last fragment may take more, one at a time, so that no two wait for each other.
/// [any-thread]
class RequestMemory {
  public:
    RequestMemory(std::size_t of_client, std::size_t of_all) : of_client_(of_client), of_all_(of_all) {}

    /// Takes `bytes` more for a request of `client`. Waits until others have released them; returns false after
    /// `longest`.
    bool take(TakenMemory& taken, const std::string& client, std::size_t bytes,
              std::chrono::milliseconds longest);
    void give_back(TakenMemory& taken);

  private:
    bool has_room(const std::string& client, std::size_t bytes) const;

    const std::size_t of_client_, of_all_;
    std::mutex mutex_;
    std::condition_variable released_;
    std::map<std::string, std::size_t> of_clients_;
    std::size_t all_ = 0;
    const TakenMemory* exceeding_ = nullptr; ///< the one that may take more
};

} // namespace RTC
