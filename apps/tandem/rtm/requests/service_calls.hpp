// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/requests/frame.hpp"
#include "apps/tandem/rtm/requests/host_components.hpp"

#include <rtm/CorbaPort.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>

namespace tandem::command {

/// Calls operations of provided service ports through a port of this program, which stays connected to each. [one
/// thread]
class ServiceCalls {
  public:
    explicit ServiceCalls(HostComponents& components);
    ~ServiceCalls();
    ServiceCalls(const ServiceCalls&) = delete;
    ServiceCalls& operator=(const ServiceCalls&) = delete;

    /// Calls an operation: `pid`, `link`; `component`: empty for the end of the link; `port`, `instance`, `operation`,
    /// `signature`, and the request's message as bytes. Returns the reply's message. Throws std::runtime_error with one
    /// line.
    std::string call(const Frame& request);

  private:
    struct Consumer;
    using Key = std::tuple<std::uint32_t, std::string, std::string, std::string, std::string>;

    Consumer& connect(const Key& key);

    HostComponents& components_;
    std::map<Key, std::unique_ptr<Consumer>> consumers_;
};

} // namespace tandem::command
