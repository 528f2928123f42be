// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm` for running components, on this machine or another. Each function prints its result
// and returns the exit code. Each throws std::runtime_error with a one-line message.
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tandem::command {

/// Prints every component in name servers and managers, with its state. Then throws if no source has answered, or if a
/// source in the options has not.
int rtm_list(const RtmClientOptions& client_options);
/// Like rtm_list(), but also prints the ports of each component and their peers.
int rtm_tree(const RtmClientOptions& client_options);
/// Prints the profile, execution contexts, configuration, ports and connections of a component.
int rtm_info(const RtmClientOptions& client_options, const std::string& component);

/// The operations of an execution context (RTC specification, ExecutionContext), and the component's exit.
enum class Transition { activate, deactivate, reset, exit };
/// Requests the transition of each component in turn, and waits for its end. Stops at the first component that refuses
/// or is not done within client_options.timeout_s. Earlier components remain changed.
int rtm_transition(const RtmClientOptions& client_options, const std::vector<std::string>& components,
                   Transition transition);

/// Options of `tandem rtm connect`. The first port is connected to each of the others.
struct ConnectOptions {
    std::vector<std::string> ports;
    std::vector<std::string> properties; ///< KEY=VALUE
    std::string name;
};
/// Refuses ports whose kinds or types do not fit, and a second connection of the same two ports.
int rtm_connect(const RtmClientOptions& client_options, const ConnectOptions& options);

/// Options of `tandem rtm disconnect`.
struct DisconnectOptions {
    std::string port;
    std::optional<std::string> other; ///< without it, all connections of `port` end
    std::string id;                   ///< empty: any
};
/// Ends the matching connections of the port. Throws if there are none.
int rtm_disconnect(const RtmClientOptions& client_options, const DisconnectOptions& options);

/// Options of `tandem rtm conf`. Without `values` and `activate`, it only prints.
struct ConfOptions {
    std::string component;
    std::vector<std::string> values; ///< NAME=VALUE
    std::string set;                 ///< empty: the active set
    std::string activate;            ///< set to activate
};
/// Sets values, activates a set, and prints the component's configuration. A refused value is an error.
int rtm_conf(const RtmClientOptions& client_options, const ConfOptions& options);

/// Options of `tandem rtm cat` and `inject`.
struct StreamOptions {
    std::string port;
    std::vector<std::filesystem::path> types; ///< libraries with stubs of further data types
    std::vector<std::string> properties;      ///< of the connection, KEY=VALUE
    unsigned long count = 0;                  ///< number of samples; 0: unlimited
    double timeout_s = 0;                     ///< for `cat`; 0: until interrupted
    bool raw = false;                         ///< prints bytes instead of members
    std::vector<std::string> values;          ///< to inject; `-`: lines of standard input
    double rate = 0;                          ///< Hz; 0: at once
};
/// Connects a port of this program to an OutPort and prints each sample as a line of JSON, until the count, the time or
/// a signal ends it. Throws if fewer than `count` samples arrived in time.
int rtm_cat(const RtmClientOptions& client_options, const StreamOptions& options);
/// Connects a port of this program to an InPort and sends the values, `count` times (0: once). Throws before sending if
/// a value from the command line does not fit the port's type.
int rtm_inject(const RtmClientOptions& client_options, const StreamOptions& options);

/// Executes the requests of `tandem monitor --control` from standard input until its end.
int rtm_requests(const RtmClientOptions& options);

/// Adds all of these commands to `tandem rtm`.
void add_running_commands(CLI::App& rtm, std::function<int()>& selected);

/// Converts KEY=VALUE arguments to connection properties. Keys without the prefix `port.` or `dataport.` get
/// `dataport.`. Throws std::runtime_error.
coil::Properties connection_properties(const std::vector<std::string>& arguments);
/// Prints a warning for each property that is probably misspelt or has a value that its key cannot have.
void warn_about_properties(const coil::Properties& properties);

} // namespace tandem::command
