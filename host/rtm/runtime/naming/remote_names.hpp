// SPDX-License-Identifier: Apache-2.0
// Components and managers of other processes by name: rtcname://HOST:PORT/CONTEXT/NAME (a name server),
// rtcloc://HOST:PORT/INSTANCE (a manager).
#pragma once
#include <omniORB4/Naming.hh>
#include <rtm/RTC.h>
#include <rtm/idl/ManagerSkel.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace RTC {

/// Nobody answers under a name; what() is one line that says which and what to do. It may be there later.
class RemoteUnavailable : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// `rtcname://localhost:2809/ctx/Name0` -> {rtcname, localhost:2809, ctx/Name0}; no scheme: {"", "", name}.
struct RemoteName {
    std::string scheme, address, path;
};
RemoteName parse_remote_name(const std::string& name);

/// `host`, `host:port` -> `host:port`.
std::string with_default_port(const std::string& address, int port);

/// Root context of a name server; throws RemoteUnavailable. Calls to it end after `milliseconds`.
CosNaming::NamingContext_ptr resolve_name_server(CORBA::ORB_ptr orb, const std::string& address,
                                                 unsigned long milliseconds = 2000);
/// `a.x/b.y` as a CORBA name. Throws RemoteUnavailable for an empty one.
CosNaming::Name to_corba_name(const std::string& path);

/// The manager at corbaloc HOST:PORT/manager; throws RemoteUnavailable.
RTM::Manager_ptr resolve_manager(CORBA::ORB_ptr orb, const std::string& address,
                                 unsigned long milliseconds = 2000);

/// The component that a name with scheme stands for; it has answered. `servers`: those meant by rtcname://*/.
/// Throws RemoteUnavailable.
RTObject_ptr resolve_component(CORBA::ORB_ptr orb, const std::string& name,
                               const std::vector<std::string>& servers, unsigned long milliseconds = 2000);

/// What a failed call means, for the end of a line: `nobody listens there`, `no answer in time` ...
std::string describe_exception(const CORBA::Exception& e);

} // namespace RTC
