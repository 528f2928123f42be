// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>
#include <omniORB4/CORBA.h>
#include <string>
#include <vector>

namespace RTC {

/// The entries of this process in CORBA name servers. A server that is away holds nobody up: what it missed
/// is made up for by update(), when it is there again. [any-thread]
class NameBindings {
  public:
    /// `host` or `host:port` each.
    NameBindings(CORBA::ORB_ptr orb, const std::vector<std::string>& servers);

    /// Binds in every server, making the contexts on the way (`host.host_cxt/Name0.rtc`). Returns one line
    /// for each server that does not take it.
    std::vector<std::string> bind(const std::string& path, CORBA::Object_ptr object);
    /// One more server; update() binds what there is.
    void add_server(const std::string& server);
    /// Removes the entry where it is still ours.
    void unbind(const std::string& path);
    /// All entries again in servers that were away, or have lost everything; with `rebind` wherever one
    /// is missing. Returns one line for each server that has come or gone.
    std::vector<std::string> update(bool rebind);
    std::vector<std::string> servers() const;

  private:
    struct Entry {
        std::string path;
        CORBA::Object_var object;
    };
    struct Server {
        std::string address;
        bool reachable = true;
    };
    std::vector<Entry> entries() const;
    void set_reachable(const std::string& address, bool reachable);
    std::string update(const Server& server, bool rebind);

    CORBA::ORB_var orb_;
    mutable std::mutex mutex_; // guards what follows; not held during calls
    std::vector<Server> servers_;
    std::vector<Entry> entries_;
};

} // namespace RTC
