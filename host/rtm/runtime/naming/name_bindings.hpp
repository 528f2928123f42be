// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <mutex>
#include <omniORB4/CORBA.h>
#include <string>
#include <vector>

namespace RTC {

/// The names that this process has bound in CORBA name servers. Owned by the manager. An unreachable server is skipped,
/// so that it does not cause delays. update() binds the names that such a server has missed. [any-thread]
class NameBindings {
  public:
    /// `servers`: HOST or HOST:PORT each. No server is called yet.
    NameBindings(CORBA::ORB_ptr orb, const std::vector<std::string>& servers);

    /// Binds the object in every server, creating the contexts of the path (`host.host_cxt/Name0.rtc`), and
    /// replaces another object of that name. Returns one message for each server that fails.
    std::vector<std::string> bind(const std::string& path, CORBA::Object_ptr object);
    /// Adds a server; update() binds the current names in it.
    void add_server(const std::string& server);
    /// Sets the function that add_server() calls for the first server. Call this before other threads start.
    void set_on_first_server(std::function<void()> on_first_server) {
        on_first_server_ = std::move(on_first_server);
    }
    /// Removes the name from every server in which it still refers to our object.
    void unbind(const std::string& path);
    /// Binds all names again in servers that were unreachable or have lost their entries. With `rebind`, also binds
    /// them in every server in which one is missing. Returns one message for each server whose state has changed.
    std::vector<std::string> update(bool rebind);
    /// Returns the addresses, HOST:PORT each.
    std::vector<std::string> servers() const;
    /// Returns the addresses of the servers that have answered the last call.
    std::vector<std::string> reachable_servers() const;

  private:
    struct Entry {
        std::string path;
        CORBA::Object_var object;
    };
    struct Server {
        std::string address;
        bool reachable = true; // at the last call
    };
    std::vector<Entry> entries() const;
    std::vector<Server> server_states() const;
    void set_reachable(const std::string& address, bool reachable);
    /// Returns a line for the log about the names that were bound again; empty if there are none.
    std::string update(const Server& server, bool rebind);

    CORBA::ORB_var orb_;
    std::function<void()> on_first_server_;
    mutable std::mutex mutex_; // guards what follows; not held during calls
    std::vector<Server> servers_;
    std::vector<Entry> entries_;
};

} // namespace RTC
