// SPDX-License-Identifier: Apache-2.0
// Shared by the sub-commands for running RT-Components: options, the ORB, and access to components and ports by name.
#pragma once
#include <coil/Properties.h>
#include <nlohmann/json.hpp>
#include <rtm/RTC.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {

/// Options of every sub-command.
struct RtmClientOptions {
    std::vector<std::string> name_servers; ///< HOST or HOST:PORT
    std::vector<std::string> managers;     ///< HOST:PORT
    double timeout_s = 5;                  ///< time limit of each remote call
    bool json = false;
    std::string endpoint; ///< address of this client's ports for TCP; empty: only on this machine
    std::string tls_authority, tls_key; ///< PEM files; with them managers are called only by TLS
};

/// A component that has answered.
struct RemoteComponent {
    RTC::RTObject_var object;
    std::string address;  ///< as users may write it: rtcname://... or rtcloc://...
    std::string instance; ///< Name0
};

/// This program's ORB, and the name servers and managers to query. Every remote call ends after options.timeout_s with
/// CORBA::TIMEOUT. Only one object at a time, because a process has one ORB. [main-thread]
class RtmClient {
  public:
    /// `with_manager`: starts RTC::Manager on the ORB, which ports of this program need. Throws CORBA::SystemException
    /// if the ORB cannot be started.
    explicit RtmClient(const RtmClientOptions& options, bool with_manager = false);
    /// Shuts the ORB or the manager down. Do not use any references afterwards.
    ~RtmClient();
    RtmClient(const RtmClient&) = delete;
    RtmClient& operator=(const RtmClient&) = delete;

    CORBA::ORB_ptr orb() const { return orb_.in(); }
    unsigned long timeout_ms() const { return timeout_ms_; }
    /// Returns HOST:PORT from the options, or from $RTCSH_NAMESERVERS (the variable of rtshell), or localhost.
    const std::vector<std::string>& name_servers() const { return name_servers_; }
    /// Returns HOST:PORT from the options, or all managers in this user's processes on this machine. The first call
    /// searches for them.
    const std::vector<std::string>& managers() const;
    /// Returns whether the options name the sources. Then only these are queried, and each must answer.
    bool has_explicit_sources() const { return has_explicit_sources_; }

    /// Finds `rtcname://HOST:PORT/PATH.rtc`, `rtcloc://HOST:PORT/NAME`, a path in the first name server, or a name in
    /// all managers and then in all name servers. Waits up to options.timeout_s for a component under creation. Throws
    /// std::runtime_error.
    RemoteComponent find_component(const std::string& name) const;

  private:
    RemoteComponent
    search_component(const std::string& name) const; // throws RTC::ComponentBeingCreated at once
    CORBA::ORB_var orb_;
    unsigned long timeout_ms_;
    bool with_manager_, has_explicit_sources_;
    std::string path_server_; // for paths without a name server
    std::vector<std::string> name_servers_;
    mutable std::optional<std::vector<std::string>> managers_; // nullopt: not searched yet
};

/// A port of a component, with its profile when it was found.
struct RemotePort {
    RTC::PortService_var object;
    RTC::PortProfile_var profile;
    std::string name; ///< Name0.port
};
/// Returns the port `COMPONENT:PORT` or `COMPONENT.PORT`. Throws std::runtime_error.
RemotePort find_port(const RtmClient& client, const std::string& name);
/// Returns a port of a component, by its name with or without the component's prefix (`Name0.`). Throws
/// std::runtime_error with a list of the existing ports.
RemotePort get_port(const RemoteComponent& component, const std::string& port);

/// Returns `CREATED`, `INACTIVE`, `ACTIVE` or `ERROR`; `NONE` without an execution context. With several contexts,
/// ERROR comes first, then ACTIVE. Throws CORBA::SystemException.
std::string component_state(RTC::RTObject_ptr component);
/// Returns the owned contexts, then the other contexts of the component. Throws std::runtime_error if there are none.
std::vector<RTC::ExecutionContext_var> execution_contexts(RTC::RTObject_ptr component);
/// Returns the name of the active configuration set; empty if the component has not activated one yet.
std::string active_configuration_set(SDOPackage::Configuration_ptr configuration);
/// Returns the meaning of a return code, as the end of a sentence about the component.
std::string to_string(RTC::ReturnCode_t code);
/// Throws std::runtime_error with one line: the address and the meaning of the exception.
[[noreturn]] void throw_corba_error(const std::string& address, const CORBA::Exception& e);

/// Runs `action`, which makes remote calls, and returns its result. Converts CORBA exceptions to std::runtime_error,
/// see throw_corba_error().
template <class Function>
auto call_remote(const std::string& address, Function action) -> decltype(action()) {
    try {
        return action();
    } catch (const CORBA::Exception& e) {
        throw_corba_error(address, e);
    }
}

} // namespace tandem::command
