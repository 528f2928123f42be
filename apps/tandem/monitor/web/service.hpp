// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/web/allowed_hosts.hpp"
#include "apps/tandem/monitor/web/page_files.hpp"
#include "apps/tandem/monitor/web/places.hpp"
#include "apps/tandem/monitor/web/request_pool.hpp"
#include "host/process/log_throttle.hpp"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace tandem::monitor {

class Channels;
class Control;
class PageSession;
class SampleFeed;

/// Data that all sessions of the server share. [one thread]
struct Service {
    std::map<std::string, PageFile, std::less<>> files;
    std::shared_ptr<const std::string> state = std::make_shared<std::string>("{}"); ///< newest, JSON
    std::function<std::string()> metrics;
    Control* control = nullptr;          ///< null: read-only
    Channels* channels = nullptr;        ///< for clients of foxglove.websocket.v1; null: the monitor ends
    SampleFeed* samples = nullptr;       ///< for plots of the page; null: the monitor ends
    std::string session_id;              ///< changes at each start of the monitor
    AllowedHosts hosts;                  ///< names by which clients may address the monitor
    std::set<std::string> other_origins; ///< origins of pages that may use foxglove.websocket.v1
    bool loopback = true;                ///< listens at an address that only this machine reaches
    Places web_sockets;
    RequestPool requests;
    process::LogThrottle refused; ///< connections for which there was no place
    std::set<PageSession*> live;  ///< receive each new state
};

} // namespace tandem::monitor
