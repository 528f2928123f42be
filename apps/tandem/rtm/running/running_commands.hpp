// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem rtm` for components that run, on this machine or another. Each prints its result, returns
// the exit code, and throws std::runtime_error with one line.
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

namespace tandem::command {

int rtm_list(const RtmClientOptions& client_options);
int rtm_tree(const RtmClientOptions& client_options);
int rtm_info(const RtmClientOptions& client_options, const std::string& component);

enum class Transition { activate, deactivate, reset, exit };
int rtm_transition(const RtmClientOptions& client_options, const std::vector<std::string>& components,
                   Transition transition);

struct ConnectOptions {
    std::vector<std::string> ports;
    std::vector<std::string> properties; ///< KEY=VALUE
    std::string name;
};
int rtm_connect(const RtmClientOptions& client_options, const ConnectOptions& options);

struct DisconnectOptions {
    std::vector<std::string> ports; ///< one: all its connections are ended; two: those between them
    std::string id;
};
int rtm_disconnect(const RtmClientOptions& client_options, const DisconnectOptions& options);

struct ConfOptions {
    std::string component;
    std::vector<std::string> values; ///< NAME=VALUE
    std::string set;                 ///< empty: the active one
    std::string activate;            ///< set to become the active one
};
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
int rtm_cat(const RtmClientOptions& client_options, const StreamOptions& options);
int rtm_inject(const RtmClientOptions& client_options, const StreamOptions& options);

/// Adds all of these to `tandem rtm`.
void add_running_commands(CLI::App& rtm, std::function<int()>& selected);

/// KEY=VALUE arguments as properties of a connection; keys that begin with neither `port.` nor `dataport.` get
/// `dataport.` in front. Throws std::runtime_error.
coil::Properties connection_properties(const std::vector<std::string>& arguments);

} // namespace tandem::command
