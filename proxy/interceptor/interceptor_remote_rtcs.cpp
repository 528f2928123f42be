// SPDX-License-Identifier: Apache-2.0
// InterceptorComp: RTCs of other processes, which come and go. Their ports have the mirrors that ports of this process have,
// connected by CORBA.
#include "proxy/interceptor/interceptor_comp.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/data/forwarding_out_port.hpp"
#include "proxy/interceptor/data/link_buffer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::interceptor {

/// `ports` are those that the RTC has now; none: it has gone. [task-thread]
void InterceptorComp::follow_remote_rtc(const std::string& component, std::vector<RtcPort> ports) {
    const auto with_name = [](auto& among, const std::string& name) {
        return std::ranges::find_if(among, [&](const auto& port) { return port.entry.name == name; });
    };
    for (const auto& shared : shared_ports_)
        if (shared.entry.component == component && table_.find(shared.entry.name) &&
            with_name(ports, shared.entry.name) == ports.end())
            end_sharing(shared);
    std::vector<RtcPort> new_ports;
    try {
        for (auto& port : ports) {
            const auto shared = with_name(shared_ports_, port.entry.name);
            if (shared == shared_ports_.end()) {
                new_ports.push_back(std::move(port));
            } else if (!table_.find(port.entry.name) ||
                       !shared->reference->_is_equivalent(port.reference.in())) {
                const auto reference = port.reference;
                share_again(*shared, std::move(port));
                shared->reference = reference;
            }
        }
        share_new_ports(std::move(new_ports));
    } catch (const std::runtime_error& error) { // it cannot be connected, and the user is strict
        log::error("{}: {}", getInstanceName(), error.what());
    }
    publish_ports();
}

/// "new": neither the remote RTC's cycle nor the thread that hands over what has come through the link waits for the other
/// process. The buffer of this side is named for this side only: OpenRTM-aist's ports do not know it.
void InterceptorComp::connect_remote(RTC::PortBase& mirror, const RtcPort& port) {
    Properties properties{
        {"dataport.interface_type", "corba_cdr"}, {"dataport.dataflow_type", "push"},
        {"dataport.subscription_type", "new"},    {"dataport.publisher.push_policy", "all"},
        {"dataport.outport.buffer.length", "64"}, {"dataport.serializer.cdr.endian", "little"}};
    if (!dynamic_cast<ForwardingOutPort*>(&mirror)) {
        properties.emplace_back("dataport.inport.buffer_type", LinkBuffer::factory_name);
        properties.emplace_back("dataport.inport.buffer.channel", channel_key(port.entry));
    }
    connect(mirror, port, port.entry.name, properties);
}

} // namespace tandem::interceptor
