// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace tandem::command {

/// Finds components of RTM hosts on this machine by the hosts' pids. Links contain these pids, and several hosts may
/// have components with the same name. [one thread]
class HostComponents {
  public:
    /// `client` must outlive this object.
    explicit HostComponents(const RtmClient& client) : client_(client) {}

    /// Returns the component with this instance name. Throws std::runtime_error with one line.
    RemoteComponent find(std::uint32_t pid, const std::string& instance);
    /// Returns the host's end of a link, an InterceptorComp. Throws std::runtime_error with one line.
    RemoteComponent find_interceptor(std::uint32_t pid, const std::string& link);
    const RtmClient& client() const { return client_; }

  private:
    const std::string& manager_of(std::uint32_t pid);
    template <class Search>
    RemoteComponent search(std::uint32_t pid, Search search);

    const RtmClient& client_;
    std::map<std::uint32_t, std::string> managers_; ///< HOST:PORT by pid
};

} // namespace tandem::command
