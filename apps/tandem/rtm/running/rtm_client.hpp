// SPDX-License-Identifier: Apache-2.0
// What the sub-commands for running RT-Components share: the ORB, the options, and finding components by
// name.
#pragma once
#include <coil/Properties.h>
#include <nlohmann/json.hpp>
#include <rtm/RTC.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {

/// Of every sub-command.
struct RtmClientOptions {
    std::vector<std::string> name_servers; ///< HOST or HOST:PORT
    std::vector<std::string> managers;     ///< HOST:PORT
    double timeout_s = 5;                  ///< bound of each call
    bool json = false;
};

/// A component that has answered, and the name it was found by.
struct RemoteComponent {
    RTC::RTObject_var object;
    std::string address;  ///< as a user can give it: rtcname://... or rtcloc://...
    std::string instance; ///< Name0
};

/// The ORB of this program, and where to look for components. Every call ends after options.seconds.
class RtmClient {
  public:
    /// `as_component`: with a manager, so that this program can have a component with ports of its own.
    explicit RtmClient(const RtmClientOptions& options, bool with_manager = false);
    ~RtmClient();
    RtmClient(const RtmClient&) = delete;
    RtmClient& operator=(const RtmClient&) = delete;

    CORBA::ORB_ptr orb() const { return orb_.in(); }
    unsigned long timeout_ms() const { return timeout_ms_; }
    /// Those of the options, else of $RTCSH_NAMESERVERS (as rtshell has it), else localhost.
    const std::vector<std::string>& name_servers() const { return name_servers_; }
    /// Those of the options, else all that this user's processes have on this machine.
    const std::vector<std::string>& managers() const { return managers_; }
    /// Have the options said where to look? Then that is all that is looked at.
    bool has_explicit_sources() const { return has_explicit_sources_; }

    /// `rtcname://HOST:PORT/PATH.rtc`, `rtcloc://HOST:PORT/NAME`, a path in the first name server, or a name
    /// for which the name servers and the managers are searched. Throws std::runtime_error.
    RemoteComponent find(const std::string& name) const;

  private:
    CORBA::ORB_var orb_;
    unsigned long timeout_ms_;
    bool with_manager_, has_explicit_sources_;
    std::string path_server_; // where paths without a server begin
    std::vector<std::string> name_servers_, managers_;
};

/// A port by `COMPONENT:port` or `COMPONENT.port`.
struct RemotePort {
    RTC::PortService_var object;
    RTC::PortProfile_var profile;
    std::string name; ///< Name0.port
};
RemotePort find_port(const RtmClient& client, const std::string& name);
/// Ports of a component, with or without `Name0.` before it.
RemotePort get_port(const RemoteComponent& component, const std::string& port);

/// `CREATED`, `INACTIVE`, `ACTIVE`, `ERROR`; `NONE`: it takes part in no execution context.
std::string component_state(RTC::RTObject_ptr component);
/// Its own contexts, then those in which it takes part; at least one, or it throws.
std::vector<RTC::ExecutionContext_var> execution_contexts(RTC::RTObject_ptr component);
/// Name of the active configuration set; empty when the component has not taken one over yet.
std::string active_configuration_set(SDOPackage::Configuration_ptr configuration);
std::string text_of(RTC::ReturnCode_t code);
/// Runs something that calls peers; CORBA exceptions become std::runtime_error with one line.
template <class Action>
auto call_remote(const std::string& address, Action action) -> decltype(action());
[[noreturn]] void throw_corba_error(const std::string& address, const CORBA::Exception& e);

template <class Action>
auto call_remote(const std::string& address, Action action) -> decltype(action()) {
    try {
        return action();
    } catch (const CORBA::Exception& e) {
        throw_corba_error(address, e);
    }
}

} // namespace tandem::command
