// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace tandem::command {

/// Finds the components of RTM hosts of this machine by the pids of these, which is how links name them: several hosts may have
/// components of one name. [one thread]
class HostComponents {
  public:
    /// `client` must outlive this object.
    explicit HostComponents(const RtmClient& client) : client_(client) {}

    /// The component of that instance name. Throws std::runtime_error, one line.
    RemoteComponent find(std::uint32_t pid, const std::string& instance);
    /// The host's end of a link: its InterceptorComp. Throws std::runtime_error, one line.
    RemoteComponent find_interceptor(std::uint32_t pid, const std::string& link);
    const RtmClient& client() const { return client_; }

  private:
    const std::string& manager_of(std::uint32_t pid);
    template <class Search>
    RemoteComponent search(std::uint32_t pid, Search search);

    const RtmClient& client_;
    std::map<std::uint32_t, std::string> managers_; ///< HOST:PORT
};

} // namespace tandem::command
