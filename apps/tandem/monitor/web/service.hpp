// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/page_files.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace tandem::monitor {

class Channels;
class Control;
class PageSession;

/// Data that all sessions of the server share. [one thread]
struct Service {
    static constexpr std::size_t max_sessions = 64; ///< served connections
    static constexpr std::size_t max_refused = 64;  ///< additional connections that receive a refusal

    std::map<std::string, PageFile, std::less<>> files;
    std::shared_ptr<const std::string> state = std::make_shared<std::string>("{}"); ///< newest, JSON
    std::function<std::string()> metrics;
    Control* control = nullptr;          ///< null: read-only
    Channels* channels = nullptr;        ///< for clients of foxglove.websocket.v1
    std::string session_id;              ///< changes at each start of the monitor
    std::set<std::string> other_origins; ///< origins of pages that may use foxglove.websocket.v1
    bool loopback = true;                ///< listens at an address that only this machine reaches
    std::size_t sessions = 0, refused = 0;
    std::set<PageSession*> live; ///< receive each new state
};

/// A session's count in one of the limits. It moves with the connection and is released at its end.
class Place {
  public:
    explicit Place(std::size_t& count) : count_(&++count) {}
    Place(Place&& from) noexcept : count_(std::exchange(from.count_, nullptr)) {}
    Place& operator=(Place&&) = delete;
    ~Place() {
        if (count_ != nullptr) --*count_;
    }

  private:
    std::size_t* count_;
};

} // namespace tandem::monitor
