// SPDX-License-Identifier: Apache-2.0
// Connections by topic: ports that name the same topic are connected without being listed in preconnect. OpenRTM-aist:
// Manager::publishPorts(), subscribePorts(), connectDataPorts() and connectServicePorts().
#pragma once
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include <chrono>
#include <rtm/idl/RTCSkel.h>
#include <set>

namespace RTC {

/// The ports of this process that name a topic: `publish_topic` of an OutPort, `subscribe_topic` of an InPort,
/// `rendezvous_point` of a service port. They are connected with the ports of the same topic in this process and with
/// those that name servers list. Owned by the manager. [any-thread]
class PortTopics {
  public:
    PortTopics(CORBA::ORB_ptr orb, NameBindings& bindings)
        : orb_(CORBA::ORB::_duplicate(orb)), bindings_(bindings) {}

    /// Binds the component's own ports in the name servers and connects them. Calls other processes. Returns one line for
    /// each failure.
    std::vector<std::string> add(RTObject_ptr component);
    /// Unbinds the ports of a component that ends.
    void remove(RTObject_ptr component);
    /// Looks for other ports again, for a name server that was not available before.
    std::vector<std::string> connect_all();

  private:
    struct TopicPort {
        std::string context;         // of the topic in a name server
        std::string kind, peer_kind; // of the names in it
        std::string name;            // Component.port
        PortService_var port;
        RTObject_var owner;

        std::string path() const { return context + "/" + name + "." + kind; }
    };
    /// One search for other ports. Names of machines that are switched off stay in name servers, and each would cost a
    /// time-out.
    struct Search {
        std::vector<std::string>& lines;
        std::set<std::string> silent_machines{};
        std::chrono::steady_clock::time_point end =
            std::chrono::steady_clock::now() + std::chrono::seconds(20);
    };
    static std::vector<TopicPort> find_topics(RTObject_ptr component, std::vector<std::string>& lines);
    std::vector<TopicPort> ports() const;
    void connect(const TopicPort& own, Search& search) const;
    void connect_published(const TopicPort& own, const std::string& server, Search& search) const;
    static void connect(const TopicPort& own, PortService_ptr other, Search& search);

    CORBA::ORB_var orb_;
    NameBindings& bindings_;
    mutable std::mutex mutex_; // not held during calls
    std::vector<TopicPort> ports_;
};

} // namespace RTC
