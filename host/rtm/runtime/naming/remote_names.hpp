// SPDX-License-Identifier: Apache-2.0
// Finds components and managers of other processes by name. rtcname://HOST:PORT/CONTEXT/NAME asks a name server,
// rtcloc://HOST:PORT/INSTANCE asks a manager, rtcloc://unix:PID/INSTANCE asks a manager of this user on this machine, and
// rtcloc://unix:self/INSTANCE that of this process. OpenRTM-aist: NamingManager::string_to_component(), NamingOnCorba and
// NamingOnManager. Programs in apps/ include this header.
#pragma once
#include "host/rtm/runtime/naming/component_creation.hpp"
#include <omniORB4/Naming.hh>
#include <rtm/RTC.h>
#include <rtm/idl/ManagerSkel.h>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <vector>

namespace RTC {

/// A name server, a manager, a component or a port of another process is not available now, but may be later. what() is
/// one line: what is unavailable, why, and what to do.
class RemoteUnavailable : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// Returns a text that changes only with the cause, for callers that log each cause once.
    virtual std::string cause() const { return what(); }
};

/// A name that no process can have: its scheme is unknown, or a part is missing.
class InvalidRemoteName : public RemoteUnavailable {
  public:
    using RemoteUnavailable::RemoteUnavailable;
};

/// A component is not available yet: its manager is still creating it.
class ComponentBeingCreated : public RemoteUnavailable {
  public:
    ComponentBeingCreated(const std::string& name, const ComponentCreation& creation)
        : RemoteUnavailable(name + " is still being created: " + creation.text()),
          cause_(name + (creation.hangs() ? hanging_text : "")) {}
    std::string cause() const override { return cause_; }

  private:
    std::string cause_; // without callback and time: after onInitialize there is briefly no callback
};

/// The parts of a name: `rtcname://localhost:2809/ctx/Name0` -> {rtcname, localhost:2809, ctx/Name0}; a name
/// without scheme -> {"", "", name}.
struct RemoteName {
    std::string scheme, address, path;
};
RemoteName parse_remote_name(const std::string& name);

/// `HOST` -> `HOST:port`; an address with a port is returned unchanged.
std::string with_default_port(const std::string& address, int port);

// All functions below: [any-thread]; they call another process and wait up to `milliseconds` for each call.
// The returned reference also has that time limit; the caller releases it. They throw
// RemoteUnavailable.

/// The root context of a name server at `HOST` or `HOST:PORT` (2809).
CosNaming::NamingContext_ptr resolve_name_server(CORBA::ORB_ptr orb, const std::string& address,
                                                 unsigned long milliseconds = 2000);

/// Returns the address of the manager in process `pid` of this user on this machine, `unix:PID`.
std::string local_manager_address(pid_t pid);

/// The manager at `HOST` or `HOST:PORT` (2810), which is the object corbaloc:iiop:HOST:PORT/manager, at `unix:PID`, or at
/// `unix:self`.
RTM::Manager_ptr resolve_manager(CORBA::ORB_ptr orb, const std::string& address,
                                 unsigned long milliseconds = 2000);

/// Returns the component of a name with scheme. It exists, because it has answered a call. Throws ComponentBeingCreated
/// if a manager of Tandem reports that, InvalidRemoteName for a name of another form. `servers` are the name servers that
/// rtcname://*/... asks, one after the other.
RTObject_ptr resolve_component(CORBA::ORB_ptr orb, const std::string& name,
                               const std::vector<std::string>& servers, unsigned long milliseconds = 2000);

/// Converts `a.x/b.y` to a CORBA name of two parts, with id and kind each. Throws RemoteUnavailable for an empty path.
CosNaming::Name to_corba_name(const std::string& path);

/// Returns the cause of a failed call as the end of a message: `connection refused`, `no answer in time` ...
std::string describe_exception(const CORBA::Exception& e);

} // namespace RTC
