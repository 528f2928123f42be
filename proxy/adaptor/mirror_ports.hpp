// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/engine/arrival_listener.hpp"
#include "proxy/adaptor/mirrors.hpp"
#include "proxy/adaptor/settings.hpp"
#include "proxy/link/link.hpp"
#include "proxy/link/registry.hpp"

#include <Component.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::adaptor {

/// The mirrors of the ports that the peer shares, as ports of AdaptorComp. A mirror is kept when the peer removes its port,
/// because the port may be added again. A port that returns with another type gets another mirror. [one thread at a time]
/// unless stated otherwise.
class MirrorPorts {
  public:
    /// Called when a mirror of `port` gets a listener for arrivals, or with nullptr loses it. Must not wait.
    using Listen = std::function<void(const link::Port& port, engine::ArrivalListener* listener)>;

    /// `bound` is called when a mirror of a required service port was connected; it must not wait. Settings and link must
    /// outlive this object.
    MirrorPorts(const Settings& settings, link::Link& link, Listen listen, std::function<void()> bound)
        : settings_(settings), link_(link), listen_(std::move(listen)), bound_(std::move(bound)) {}

    /// Gives `owner` a mirror of each port in the peer's table, and removes all others. The owner deletes the service ports
    /// that it has.
    void update(const link::PortTable& peer, Component& owner);

    std::vector<engine::RequiredPort*> required() const { return required_.all(); } ///< [any-thread]
    /// Returns the mirror of the peer's required service port of this name; nullptr if there is none. [any-thread]
    engine::RequiredPort* find_required(std::string_view name) const { return required_.find(name); }
    /// The same by link::port_id() of the name. Takes no lock. [any-thread]
    engine::RequiredPort* find_required(std::uint64_t port_id) const { return required_.find(port_id); }
    /// Returns the reason of a refused connection; empty if none was refused.
    std::string first_refusal() const;
    /// Returns a line for each property of a port that has no effect with the ports in the peer's table.
    std::vector<std::string> find_useless_properties(const link::PortTable& peer) const;

  private:
    struct Mirror {
        link::Port peer;
        Port* port = nullptr;
        bool shown = true;              ///< the owner has this port
        std::unique_ptr<Port> hidden{}; ///< a service port, while the owner does not have it
    };
    Mirror* find_mirror(const link::Port& port);
    void log_changed_type(const link::Port& port, const std::string& owner);
    void set_policy(const link::Port& port);
    void show(Mirror& mirror, Component& owner);
    void hide(Mirror& mirror, Component& owner);
    void log_changes(const link::PortTable& peer, const std::string& owner);
    Port* create_mirror(const link::Port& port);
    bool is_event_port(const link::Port& port) const;
    template <class MirrorPort, class... Arguments>
    Port* add(std::vector<std::unique_ptr<MirrorPort>>& mirrors, const link::Port& port,
              Arguments&&... arguments);
    std::function<void(engine::ArrivalListener*)> listen_to(const link::Port& port) const;

    const Settings& settings_;
    link::Link& link_;
    const Listen listen_;
    const std::function<void()> bound_;
    bool updated_ = false;
    std::multimap<std::string, Mirror> mirrors_; ///< all mirrors ever created, by name
    std::vector<std::unique_ptr<engine::InPort>> inputs_;
    std::vector<std::unique_ptr<engine::OutPort>> outputs_;
    std::vector<std::unique_ptr<engine::EventInPort>> event_inputs_;
    std::vector<std::unique_ptr<engine::EventOutPort>> event_outputs_;
    std::vector<std::unique_ptr<engine::FsmPort>> fsm_ports_;
    link::Registry<engine::RequiredPort> required_; ///< the owner's, or hidden
};

} // namespace tandem::adaptor
