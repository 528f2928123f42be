// SPDX-License-Identifier: Apache-2.0
// Callbacks at the steps of connecting and disconnecting a port.
#ifndef RTC_PORTCONNECTLISTENER_H
#define RTC_PORTCONNECTLISTENER_H
#include <array>
#include <cstdint>
#include <rtm/ListenerHolder.h>
#include <rtm/RTC.h>

namespace RTC {

/// Steps without a result.
enum class PortConnectListenerType : std::uint8_t {
    ON_NOTIFY_CONNECT,
    ON_NOTIFY_DISCONNECT,
    ON_UNSUBSCRIBE_INTERFACES,
    PORT_CONNECT_LISTENER_NUM
};
/// Steps with a result.
enum class PortConnectRetListenerType : std::uint8_t {
    ON_PUBLISH_INTERFACES,
    ON_CONNECT_NEXTPORT,
    ON_SUBSCRIBE_INTERFACES,
    ON_CONNECTED,
    ON_DISCONNECT_NEXT,
    ON_DISCONNECTED,
    PORT_CONNECT_RET_LISTENER_NUM
};

// The unscoped names that components for 1.x use.
constexpr auto ON_NOTIFY_CONNECT = PortConnectListenerType::ON_NOTIFY_CONNECT;
constexpr auto ON_NOTIFY_DISCONNECT = PortConnectListenerType::ON_NOTIFY_DISCONNECT;
constexpr auto ON_UNSUBSCRIBE_INTERFACES = PortConnectListenerType::ON_UNSUBSCRIBE_INTERFACES;
constexpr auto PORT_CONNECT_LISTENER_NUM = PortConnectListenerType::PORT_CONNECT_LISTENER_NUM;
constexpr auto ON_PUBLISH_INTERFACES = PortConnectRetListenerType::ON_PUBLISH_INTERFACES;
constexpr auto ON_CONNECT_NEXTPORT = PortConnectRetListenerType::ON_CONNECT_NEXTPORT;
constexpr auto ON_SUBSCRIBE_INTERFACES = PortConnectRetListenerType::ON_SUBSCRIBE_INTERFACES;
constexpr auto ON_CONNECTED = PortConnectRetListenerType::ON_CONNECTED;
constexpr auto ON_DISCONNECT_NEXT = PortConnectRetListenerType::ON_DISCONNECT_NEXT;
constexpr auto ON_DISCONNECTED = PortConnectRetListenerType::ON_DISCONNECTED;
constexpr auto PORT_CONNECT_RET_LISTENER_NUM = PortConnectRetListenerType::PORT_CONNECT_RET_LISTENER_NUM;

/// Called before the step, in the connecting thread. May change the profile.
class PortConnectListener {
  public:
    static const char* toString(PortConnectListenerType type);
    virtual ~PortConnectListener() = default;
    virtual void operator()(const char* portname, RTC::ConnectorProfile& profile) = 0;
};
/// Called after the step, with its result.
class PortConnectRetListener {
  public:
    static const char* toString(PortConnectRetListenerType type);
    virtual ~PortConnectRetListener() = default;
    virtual void operator()(const char* portname, RTC::ConnectorProfile& profile, ReturnCode_t ret) = 0;
};

} // namespace RTC

extern template class RTM::util::ListenerHolder<RTC::PortConnectListener>;
extern template class RTM::util::ListenerHolder<RTC::PortConnectRetListener>;

namespace RTC {

/// A port's listeners by type. [any-thread]
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
