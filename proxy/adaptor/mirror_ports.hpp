// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/data/mirror_in_port.hpp"
#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/adaptor/event/mirror_event_in_port.hpp"
#include "proxy/adaptor/event/mirror_event_out_port.hpp"
#include "proxy/adaptor/event/mirror_fsm_port.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "proxy/adaptor/settings.hpp"
#include "proxy/link/link.hpp"

#include <Component.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::adaptor {

/// The mirrors of the ports that the peer shares, as ports of AdaptorComp. Not synchronized: create() before all else.
class MirrorPorts {
  public:
    /// Called when a mirror of that port gets a listener for arrivals, nullptr when it loses it; must not wait.
    using Listen = std::function<void(const std::string& port, DataPortListener* listener)>;

    /// Settings and link must outlive it.
    MirrorPorts(const Settings& settings, link::Link& link, Listen listen)
        : settings_(settings), link_(link), listen_(std::move(listen)) {}

    /// Creates a mirror of each port in the peer's table and adds it to `owner`, which deletes the service ports.
    void create(const link::PortTable& peer, Component& owner);

    const std::vector<MirrorRequiredPort*>& required() const { return required_; }
    /// The mirror of the peer's required service port of that name; nullptr if there is none.
    MirrorRequiredPort* find_required(std::string_view name) const;
    /// Why the first connection that was refused was refused; empty if there is none.
    std::string first_refusal() const;

  private:
    void set_policy(const link::Port& port);
    void create_mirror(const link::Port& port, Component& owner);
    bool is_event_port(const link::Port& port) const;
    template <class Mirror, class... Arguments>
    void add(std::vector<std::unique_ptr<Mirror>>& mirrors, const link::Port& port, Component& owner,
             Arguments&&... arguments);
    std::function<void(DataPortListener*)> listen_to(const std::string& port) const;

    const Settings& settings_;
    link::Link& link_;
    const Listen listen_;
    std::vector<std::unique_ptr<MirrorInPort>> inputs_;
    std::vector<std::unique_ptr<MirrorOutPort>> outputs_;
    std::vector<std::unique_ptr<MirrorEventInPort>> event_inputs_;
    std::vector<std::unique_ptr<MirrorEventOutPort>> event_outputs_;
    std::vector<std::unique_ptr<MirrorFsmPort>> fsm_ports_;
    std::vector<MirrorRequiredPort*> required_; ///< the owner's
};

} // namespace tandem::adaptor
