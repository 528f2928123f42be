// SPDX-License-Identifier: Apache-2.0
// What the sub-commands for running RT-Components share: their common options, the ORB, and access to components and
// ports by name.
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
    std::string
        endpoint; ///< address at which this client's own ports are reached by TCP; empty: on this machine only
    std::string tls_authority, tls_key; ///< files in PEM; with them managers are called by TLS alone
};

/// A component that has answered.
struct RemoteComponent {
    RTC::RTObject_var object;
    std::string address;  ///< as a user can give it: rtcname://... or rtcloc://...
    std::string instance; ///< Name0
};

/// The ORB of this program, and the name servers and managers to ask for components. Every remote call ends after
/// options.timeout_s with CORBA::TIMEOUT. One at a time, since the ORB is the process's. [main-thread]
class RtmClient {
  public:
    /// `with_manager`: starts RTC::Manager on the ORB, which ports of this program's own need.
    /// Throws CORBA::SystemException if the ORB cannot be started.
    explicit RtmClient(const RtmClientOptions& options, bool with_manager = false);
    /// Shuts the ORB or the manager down: references that are still held must not be used any more.
    ~RtmClient();
    RtmClient(const RtmClient&) = delete;
    RtmClient& operator=(const RtmClient&) = delete;

    CORBA::ORB_ptr orb() const { return orb_.in(); }
    unsigned long timeout_ms() const { return timeout_ms_; }
    /// HOST:PORT of the options, else of $RTCSH_NAMESERVERS (the variable of rtshell), else of localhost.
    const std::vector<std::string>& name_servers() const { return name_servers_; }
    /// HOST:PORT of the options, else of all managers in this user's processes on this machine, which the first call searches.
    const std::vector<std::string>& managers() const;
    /// Whether the options name the sources: then no others are asked, and each must answer.
    bool has_explicit_sources() const { return has_explicit_sources_; }

    /// `rtcname://HOST:PORT/PATH.rtc`, `rtcloc://HOST:PORT/NAME`, a path in the first name server, or a name
    /// that is looked up in all managers, then in all name servers. Waits up to options.timeout_s for a component that
    /// its manager is still creating. Throws std::runtime_error.
    RemoteComponent find_component(const std::string& name) const;

  private:
    RemoteComponent
    search_component(const std::string& name) const; // throws RTC::ComponentBeingCreated at once
    CORBA::ORB_var orb_;
    unsigned long timeout_ms_;
    bool with_manager_, has_explicit_sources_;
    std::string path_server_; // the name server of paths that name none
    std::vector<std::string> name_servers_;
    mutable std::optional<std::vector<std::string>> managers_; // none: not searched for yet
};

/// A port of a component, with its profile as it was when it was found.
struct RemotePort {
    RTC::PortService_var object;
    RTC::PortProfile_var profile;
    std::string name; ///< Name0.port
};
/// The port `COMPONENT:PORT` or `COMPONENT.PORT`. Throws std::runtime_error.
RemotePort find_port(const RtmClient& client, const std::string& name);
/// A port of a component, by its name with or without the component's (`Name0.`) before it. Throws
/// std::runtime_error that lists the ports there are.
RemotePort get_port(const RemoteComponent& component, const std::string& port);

/// `CREATED`, `INACTIVE`, `ACTIVE` or `ERROR`; `NONE` if it takes part in no execution context. Of several contexts the
/// state that matters most: ERROR, then ACTIVE. Throws CORBA::SystemException.
std::string component_state(RTC::RTObject_ptr component);
/// The contexts that it owns, then those in which it takes part. Throws std::runtime_error if there are none.
std::vector<RTC::ExecutionContext_var> execution_contexts(RTC::RTObject_ptr component);
/// Name of the active configuration set; empty if the component has not activated one yet.
std::string active_configuration_set(SDOPackage::Configuration_ptr configuration);
/// What a return code means, as the end of a sentence about the component.
std::string to_string(RTC::ReturnCode_t code);
/// Throws std::runtime_error, one line with the address and the meaning of the exception.
[[noreturn]] void throw_corba_error(const std::string& address, const CORBA::Exception& e);

/// Runs `action`, which makes remote calls, and returns its result. CORBA exceptions become std::runtime_error, see
/// throw_corba_error().
template <class Function>
auto call_remote(const std::string& address, Function action) -> decltype(action()) {
    try {
        return action();
    } catch (const CORBA::Exception& e) {
        throw_corba_error(address, e);
    }
}

} // namespace tandem::command
