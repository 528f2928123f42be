// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/sdo/message_events.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include <atomic>
#include <coil/stringutil.h>
#include <optional>

namespace RTC {
namespace {

using Tell = std::function<void(const std::string&)>;

/// Takes messages as values as well, so none is serialized for it. Several connections may call it at a time.
class MessageEvent : public ConnectorDataListener {
  public:
    MessageEvent(Tell tell, std::string hint, std::chrono::nanoseconds interval)
        : tell_(std::move(tell)), hint_(std::move(hint)), interval_(interval) {}
    ReturnCode operator()(ConnectorInfo&, ByteData&, const std::string&) override { return note(); }
    bool takesValues(const std::type_info&) const override { return true; }
    ReturnCode notifyValue(ConnectorInfo&, void*) override { return note(); }

  private:
    ReturnCode note() {
        const auto now = std::chrono::steady_clock::now();
        auto due = due_.load();
        if (now >= due && due_.compare_exchange_strong(due, now + interval_)) tell_(hint_);
        return NO_CHANGE;
    }

    const Tell tell_;
    const std::string hint_;
    const std::chrono::nanoseconds interval_;
    std::atomic<std::chrono::steady_clock::time_point> due_{};
};

std::optional<std::chrono::nanoseconds> read_interval(const coil::Properties& settings, const char* key) {
    std::chrono::nanoseconds interval{};
    if (!coil::stringTo(interval, settings.getProperty(key).c_str()) || interval < std::chrono::seconds(0))
        return {};
    return interval;
}

// By reference, because the component's threads may add and remove ports meanwhile. A composite's ports belong to others.
template <class Port>
void listen(std::vector<std::function<void()>>& removals, RTObject_impl& component,
            ConnectorDataListenerType type, const std::string& event, std::chrono::nanoseconds interval,
            const Tell& tell) {
    const RTObject_var self = component.getObjRef();
    PortServiceList_var ports = component.get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        const auto port = local_object<Port>(ports[i]);
        if (!port || !self->_is_equivalent(port->profileWithoutConnections().owner)) continue;
        auto* listener = new MessageEvent(tell, event + port->getName(), interval);
        port->addConnectorDataListener(type, listener);
        removals.push_back([reference = PortService_var(PortService::_duplicate(ports[i])), type, listener] {
            if (const auto present = local_object<Port>(reference.in()))
                present->removeConnectorDataListener(type, listener);
        });
    }
}

} // namespace

std::vector<std::function<void()>> listen_to_messages(RTObject_impl& component,
                                                      const coil::Properties& settings, const Tell& tell) {
    std::vector<std::function<void()>> removals;
    if (const auto interval = read_interval(settings, "port_profile.send_event.min_interval"))
        listen<OutPortBase>(removals, component, ConnectorDataListenerType::ON_SEND,
                            "SEND:OutPort:", *interval, tell);
    if (const auto interval = read_interval(settings, "port_profile.receive_event.min_interval"))
        listen<InPortBase>(removals, component, ConnectorDataListenerType::ON_RECEIVED,
                           "RECEIVE:InPort:", *interval, tell);
    return removals;
}

} // namespace RTC
