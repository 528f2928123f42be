// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>
#include <omniORB4/CORBA.h>
#include <string>
#include <vector>

namespace RTC {

/// The entries of this process in CORBA name servers. [any-thread]
class Naming {
  public:
    /// `host` or `host:port` each.
    Naming(CORBA::ORB_ptr orb, std::vector<std::string> servers);

    /// Binds in every server, making the contexts on the way (`host.host_cxt/Name0.rtc`). Returns one line
    /// for each server that does not take it.
    std::vector<std::string> bind(const std::string& path, CORBA::Object_ptr object);
    void unbind(const std::string& path);

  private:
    CORBA::ORB_var orb_;
    std::vector<std::string> servers_;
};

} // namespace RTC
