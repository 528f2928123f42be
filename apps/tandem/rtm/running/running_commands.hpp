// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm` for components that run, on this machine or another. Each prints its result, returns
// the exit code, and throws std::runtime_error with one line.
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <filesystem>
#include <functional>

namespace CLI {
class App;
}

namespace tandem::command {

/// Prints every component that name servers and managers list, with its state. Throws after that if no source has
/// answered, or one that the options name has not.
int rtm_list(const RtmClientOptions& client_options);
/// The same with the ports of each component and with the ports that these are connected with.
int rtm_tree(const RtmClientOptions& client_options);
/// Prints profile, execution contexts, configuration, ports and connections of one component.
int rtm_info(const RtmClientOptions& client_options, const std::string& component);

/// The operations of an execution context (RTC specification, ExecutionContext), and exit of the component itself.
enum class Transition { activate, deactivate, reset, exit };
/// Requests the transition of each component, one after the other, and waits until it has been carried out. Ends at the
/// first component that refuses or does not get there in client_options.timeout_s; those before it have changed.
int rtm_transition(const RtmClientOptions& client_options, const std::vector<std::string>& components,
                   Transition transition);

/// Of connect: the first port is connected with each of the others.
struct ConnectOptions {
    std::vector<std::string> ports;
    std::vector<std::string> properties; ///< KEY=VALUE
    std::string name;
};
/// Refuses ports whose kinds or types do not fit, and a second connection of the same two ports.
int rtm_connect(const RtmClientOptions& client_options, const ConnectOptions& options);

/// Of disconnect.
struct DisconnectOptions {
    std::vector<std::string> ports; ///< one: all its connections are ended; two: those between them
    std::string id;
};
/// Ends the connections of the first port that match. Throws if there are none.
int rtm_disconnect(const RtmClientOptions& client_options, const DisconnectOptions& options);

/// Of conf. Without values and `activate` it only prints.
struct ConfOptions {
    std::string component;
    std::vector<std::string> values; ///< NAME=VALUE
    std::string set;                 ///< empty: the active one
    std::string activate;            ///< set to become the active one
};
/// Sets values, then activates a set, then prints what the component has. A value that it refuses is an error.
int rtm_conf(const RtmClientOptions& client_options, const ConfOptions& options);

/// Of cat and inject.
struct StreamOptions {
    std::string port;
    std::vector<std::filesystem::path> types; ///< libraries with stubs of further data types
    std::vector<std::string> properties;      ///< of the connection, KEY=VALUE
    unsigned long count = 0;                  ///< of samples; 0: any number
    double timeout_s = 0;                     ///< of `cat`; 0: until interrupted
    bool raw = false;                         ///< prints bytes instead of members
    std::vector<std::string> values;          ///< to inject; `-`: lines of standard input
    double rate = 0;                          ///< Hz, 0: at once
};
/// Connects a port of this program with an OutPort and prints each sample as a line of JSON, until the count, the time
/// or a signal ends it. Throws if fewer than `count` samples came in the time.
int rtm_cat(const RtmClientOptions& client_options, const StreamOptions& options);
/// Connects a port of this program with an InPort and sends the values to it, `count` times (0: once). Throws before
/// the first is sent if a value of the command line does not fit the port's type.
int rtm_inject(const RtmClientOptions& client_options, const StreamOptions& options);

/// Carries out the requests of `tandem monitor --control` that come by standard input, until that ends.
int rtm_requests(const RtmClientOptions& options);

/// Adds all of these to `tandem rtm`.
void add_running_commands(CLI::App& rtm, std::function<int()>& selected);

/// KEY=VALUE arguments as properties of a connection; keys that begin with neither `port.` nor `dataport.` get
/// `dataport.` in front. Throws std::runtime_error.
coil::Properties connection_properties(const std::vector<std::string>& arguments);

} // namespace tandem::command
