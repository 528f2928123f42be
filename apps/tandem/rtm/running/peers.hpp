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
struct PeerOptions {
    std::vector<std::string> name_servers; ///< HOST or HOST:PORT
    std::vector<std::string> managers;     ///< HOST:PORT
    double seconds = 5;                    ///< bound of each call
    bool json = false;
};

/// A component that has answered, and the name it was found by.
struct Component {
    RTC::RTObject_var object;
    std::string address;  ///< as a user can give it: rtcname://... or rtcloc://...
    std::string instance; ///< Name0
};

/// The ORB of this program, and where to look for components. Every call ends after options.seconds.
class Peers {
  public:
    /// `as_component`: with a manager, so that this program can have a component with ports of its own.
    explicit Peers(const PeerOptions& options, bool as_component = false);
    ~Peers();
    Peers(const Peers&) = delete;
    Peers& operator=(const Peers&) = delete;

    CORBA::ORB_ptr orb() const { return orb_.in(); }
    unsigned long call_ms() const { return call_ms_; }
    /// Those of the options, else of $RTCSH_NAMESERVERS (as rtshell has it), else localhost.
    const std::vector<std::string>& name_servers() const { return name_servers_; }
    /// Those of the options, else all that this user's processes have on this machine.
    const std::vector<std::string>& managers() const { return managers_; }
    /// Have the options said where to look? Then that is all that is looked at.
    bool named() const { return named_; }

    /// `rtcname://HOST:PORT/PATH.rtc`, `rtcloc://HOST:PORT/NAME`, a path in the first name server, or a name
    /// for which the name servers and the managers are searched. Throws std::runtime_error.
    Component find(const std::string& name) const;

  private:
    CORBA::ORB_var orb_;
    unsigned long call_ms_;
    bool as_component_, named_;
    std::string path_server_; // where paths without a server begin
    std::vector<std::string> name_servers_, managers_;
};

/// A port by `COMPONENT:port` or `COMPONENT.port`.
struct Port {
    RTC::PortService_var object;
    RTC::PortProfile_var profile;
    std::string name; ///< Name0.port
};
Port find_port(const Peers& peers, const std::string& name);
/// Ports of a component, with or without `Name0.` before it.
Port port_of(const Component& component, const std::string& port);

/// `CREATED`, `INACTIVE`, `ACTIVE`, `ERROR`; `NONE`: it takes part in no execution context.
std::string state_of(RTC::RTObject_ptr component);
/// Its own contexts, then those in which it takes part; at least one, or it throws.
std::vector<RTC::ExecutionContext_var> contexts_of(RTC::RTObject_ptr component);
/// Name of the active configuration set; empty when the component has not taken one over yet.
std::string active_set(SDOPackage::Configuration_ptr configuration);
std::string text_of(RTC::ReturnCode_t code);
/// Runs something that calls peers; CORBA exceptions become std::runtime_error with one line.
template <class Action>
auto calling(const std::string& whom, Action action) -> decltype(action());
[[noreturn]] void give_up(const std::string& whom, const CORBA::Exception& e);

template <class Action>
auto calling(const std::string& whom, Action action) -> decltype(action()) {
    try {
        return action();
    } catch (const CORBA::Exception& e) {
        give_up(whom, e);
    }
}

} // namespace tandem::command
