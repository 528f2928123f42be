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

/// What all sessions of the server share. [one thread]
struct Service {
    static constexpr std::size_t max_sessions = 64; ///< connections that are served
    static constexpr std::size_t max_refused = 64;  ///< connections beyond those that are told so

    std::map<std::string, PageFile, std::less<>> files;
    std::shared_ptr<const std::string> state = std::make_shared<std::string>("{}"); ///< newest, JSON
    std::function<std::string()> metrics;
    Control* control = nullptr;          ///< null: nothing may be controlled
    Channels* channels = nullptr;        ///< for clients of foxglove.websocket.v1
    std::string session_id;              ///< another one for each start of the monitor
    std::set<std::string> other_origins; ///< of pages that may look by foxglove.websocket.v1
    bool loopback = true;                ///< listens at an address that only this machine reaches
    std::size_t sessions = 0, refused = 0;
    std::set<PageSession*> live; ///< get each new state
};

/// A session's place among those that are counted; given back at its end. Moves with the connection.
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
