// SPDX-License-Identifier: Apache-2.0
// Callbacks of the steps by which a port is connected and disconnected.
#ifndef RTC_PORTCONNECTLISTENER_H
#define RTC_PORTCONNECTLISTENER_H
#include <array>
#include <cstdint>
#include <rtm/ListenerHolder.h>
#include <rtm/RTC.h>

namespace RTC {

enum class PortConnectListenerType : std::uint8_t {
    ON_NOTIFY_CONNECT,
    ON_NOTIFY_DISCONNECT,
    ON_UNSUBSCRIBE_INTERFACES,
    PORT_CONNECT_LISTENER_NUM
};
/// Of steps with a result.
enum class PortConnectRetListenerType : std::uint8_t {
    ON_PUBLISH_INTERFACES,
    ON_CONNECT_NEXTPORT,
    ON_SUBSCRIBE_INTERFACES,
    ON_CONNECTED,
    ON_DISCONNECT_NEXT,
    ON_DISCONNECTED,
    PORT_CONNECT_RET_LISTENER_NUM
};

class PortConnectListener {
public:
    virtual ~PortConnectListener() = default;
    virtual void operator()(const char* portname, RTC::ConnectorProfile& profile) = 0;
};
class PortConnectRetListener {
public:
    virtual ~PortConnectRetListener() = default;
    virtual void operator()(const char* portname, RTC::ConnectorProfile& profile, ReturnCode_t ret) = 0;
};

/// A port's listeners by kind. [any-thread]
class PortConnectListeners {
public:
    RTM::util::ListenerHolder<PortConnectListener>& at(PortConnectListenerType type) {
        return portconnect_.at(static_cast<std::size_t>(type));
    }
    RTM::util::ListenerHolder<PortConnectRetListener>& at(PortConnectRetListenerType type) {
        return portconnret_.at(static_cast<std::size_t>(type));
    }

private:
    std::array<RTM::util::ListenerHolder<PortConnectListener>,
               static_cast<std::size_t>(PortConnectListenerType::PORT_CONNECT_LISTENER_NUM)>
        portconnect_;
    std::array<RTM::util::ListenerHolder<PortConnectRetListener>,
               static_cast<std::size_t>(PortConnectRetListenerType::PORT_CONNECT_RET_LISTENER_NUM)>
        portconnret_;
};

} // namespace RTC
#endif
