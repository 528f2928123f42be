// SPDX-License-Identifier: Apache-2.0
#ifndef TANDEM_RTCCONNECTORREQUIRED_H_
#define TANDEM_RTCCONNECTORREQUIRED_H_

#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <string>
#include <vector>

/// The service RtcConnector of an AdaptorComp whose InterceptorComp has `manage=yes`. A port is named by an RTC as in
/// RtcManagerRequired.h, a dot and the port's name. Each method throws MethodInvokeException if it fails.
class RtcConnectorRequired : public RequiredServicePort {
  public:
    typedef std::vector<std::string> Names;

    RtcConnectorRequired() {
        m_connect = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcConnectorRequired::connect, "connect")));
        m_disconnect = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcConnectorRequired::disconnect, "disconnect")));
        m_connections = reinterpret_cast<RequiredMethod<Names>*>(
            add(makeRequiredMethod(&RtcConnectorRequired::connections, "connections")));
    }

    /// Connects two ports. Each of `properties` is KEY=VALUE, such as `subscription_type=new`.
    void connect(std::string from, std::string to, Names properties) { (*m_connect)(from, to, properties); }
    /// Ends all connections between the two ports.
    void disconnect(std::string from, std::string to) { (*m_disconnect)(from, to); }
    /// Returns the names of the connected ports as their RTCs report them: `Name0.port`, without an address even for
    /// another host. One entry for each connection.
    Names connections(std::string port) { return (*m_connections)(port); }

  private:
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    RequiredMethod<void>* m_connect;
    RequiredMethod<void>* m_disconnect;
    RequiredMethod<Names>* m_connections;
};

#endif
