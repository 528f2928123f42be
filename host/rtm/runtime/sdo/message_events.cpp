// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/sdo/message_events.hpp"
#include <algorithm>
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

// A port may be removed, with its listeners, before the tool goes.
template <class Port>
void listen(std::vector<std::function<void()>>& removals, const std::vector<Port*>& ports,
            ConnectorDataListenerType type, const std::string& event, std::chrono::nanoseconds interval,
            const Tell& tell) {
    for (Port* port : ports) {
        auto* listener = new MessageEvent(tell, event + port->getName(), interval);
        port->addConnectorDataListener(type, listener);
        removals.push_back([&ports, port, type, listener] {
            if (std::find(ports.begin(), ports.end(), port) != ports.end())
                port->removeConnectorDataListener(type, listener);
        });
    }
}

} // namespace

std::vector<std::function<void()>> listen_to_messages(RTObject_impl& component,
                                                      const coil::Properties& settings, const Tell& tell) {
    std::vector<std::function<void()>> removals;
    if (const auto interval = read_interval(settings, "port_profile.send_event.min_interval"))
        listen(removals, component.getOutPorts(), ConnectorDataListenerType::ON_SEND,
               "SEND:OutPort:", *interval, tell);
    if (const auto interval = read_interval(settings, "port_profile.receive_event.min_interval"))
        listen(removals, component.getInPorts(), ConnectorDataListenerType::ON_RECEIVED,
               "RECEIVE:InPort:", *interval, tell);
    return removals;
}

} // namespace RTC
