// SPDX-License-Identifier: Apache-2.0
// The command line of the `tandem rtm` commands for running components.
#include "apps/tandem/rtm/running/running_commands.hpp"
#include "apps/tandem/rtm/record/rtm_record.hpp"

#include "apps/tandem/commands.hpp"
#include "host/options/number_check.hpp"

#include <cctype>
#include <memory>

namespace tandem::command {
namespace {

// Components call the ports of these commands.
void add_endpoint(CLI::App& command, RtmClientOptions& client) {
    command.add_option(
        "--endpoint", client.endpoint,
        "address of this machine for components that can reach this command only by TCP: on "
        "another machine, or in Java; every machine may connect to it while the command runs (none)");
}

// The environment can set these options too, because every command in a system with TLS needs them.
void add_tls(CLI::App& command, RtmClientOptions& client) {
    command
        .add_option("--tls-authority", client.tls_authority,
                    "PEM file with the certificates to trust, for TLS")
        ->envname("TANDEM_TLS_AUTHORITY");
    command
        .add_option("--tls-key", client.tls_key, "PEM file with this client's key and certificate, for TLS")
        ->envname("TANDEM_TLS_KEY");
}

// The last lines of --help of each command that takes COMPONENT or PORT.
constexpr const char* addresses =
    R"(COMPONENT is rtcname://HOST:PORT/PATH/NAME.rtc (a name server), rtcloc://HOST:PORT/NAME (a manager), a
path PATH/NAME.rtc in the default name server, or a NAME. A NAME is looked up in the name servers and in
this user's managers on this machine. With --nameserver or --manager only those are searched.
A port is COMPONENT:PORT.
Exit code 1 if a named component does not exist or does not answer in time, or if no server answers.)";

// The last lines of --help of `list` and `tree`.
constexpr const char* listed_servers =
    R"(Lists the components of the name servers and of this user's managers on this machine. With --nameserver
or --manager only those are asked, and the command fails unless each of them answers.
Exit code 1 if no server answers.)";

// Adds a sub-command with the options common to all.
CLI::App* add_client_command(CLI::App& rtm, const char* name, const char* brief, RtmClientOptions& client,
                             const std::string& details) {
    CLI::App* command = rtm.add_subcommand(name, brief);
    command->footer(details);
    command
        ->add_option("--nameserver", client.name_servers,
                     "HOST or HOST:PORT of a name server (repeatable; $RTCSH_NAMESERVERS or localhost)")
        ->allow_extra_args(false);
    command
        ->add_option("--manager", client.managers,
                     "HOST or HOST:PORT of a manager (repeatable; those found on this machine)")
        ->allow_extra_args(false);
    command->add_option("--timeout", client.timeout_s, "time limit for each call, in seconds (5)")
        ->check(options::number_between(0.1, 3600.));
    command->add_flag("--json", client.json, "print JSON instead of text");
    add_tls(*command, client);
    return command;
}

// Adds a sub-command that takes components or ports.
CLI::App* add_running_command(CLI::App& rtm, const char* name, const char* brief, RtmClientOptions& client,
                              const std::string& details = "") {
    return add_client_command(rtm, name, brief, client, details + (details.empty() ? "" : "\n") + addresses);
}

// The options of a command, and those common to all.
template <class Options>
struct Running {
    RtmClientOptions client;
    Options options;
};

// Makes the command run a function with its options. The callback holds them, because CLI11 fills them later.
template <class Options>
void run_when_chosen(CLI::App* command, Action& selected, const std::shared_ptr<Running<Options>>& chosen,
                     int (*run)(const RtmClientOptions&, const Options&)) {
    command->callback([=, &selected] { selected = [=] { return run(chosen->client, chosen->options); }; });
}

// list, tree and info: they show components, ports and connections.
void add_listings(CLI::App& rtm, Action& selected) {
    auto list = std::make_shared<RtmClientOptions>();
    add_client_command(rtm, "list", "Lists running components on this machine and in name servers", *list,
                       std::string("A component that does not answer is listed as UNREACHABLE.\n") +
                           listed_servers)
        ->callback([=, &selected] { selected = [list] { return rtm_list(*list); }; });
    auto tree = std::make_shared<RtmClientOptions>();
    add_client_command(rtm, "tree", "Lists components with their ports and connections", *tree,
                       listed_servers)
        ->callback([=, &selected] { selected = [tree] { return rtm_tree(*tree); }; });
    auto info = std::make_shared<Running<std::string>>();
    CLI::App* command = add_running_command(
        rtm, "info", "Shows a component: profile, contexts, ports, connections", info->client);
    command->add_option("COMPONENT", info->options, "component, see below")->required();
    run_when_chosen(command, selected, info, rtm_info);
}

// activate, deactivate, reset and exit: the same command line for all four.
void add_transitions(CLI::App& rtm, Action& selected) {
    auto add_transition = [&](const char* name, const char* brief, Transition transition) {
        auto options = std::make_shared<Running<std::vector<std::string>>>();
        CLI::App* command = add_running_command(rtm, name, brief, options->client);
        command->add_option("COMPONENT", options->options, "components, see below")->required();
        command->callback([=, &selected] {
            selected = [=] { return rtm_transition(options->client, options->options, transition); };
        });
    };
    add_transition("activate", "Activates components and waits until they are active", Transition::activate);
    add_transition("deactivate", "Deactivates components and waits until they are inactive",
                   Transition::deactivate);
    add_transition("reset", "Resets components from ERROR to INACTIVE", Transition::reset);
    add_transition("exit", "Makes components exit", Transition::exit);
}

// connect and disconnect.
void add_connections(CLI::App& rtm, Action& selected) {
    auto connect = std::make_shared<Running<ConnectOptions>>();
    CLI::App* command = add_running_command(
        rtm, "connect", "Connects the first port to each of the others", connect->client,
        "Properties are those of manager.components.preconnect, for example dataflow_type=pull, "
        "subscription_type=new.");
    command->add_option("PORT", connect->options.ports, "two ports or more")->required()->expected(2, -1);
    command->add_option("-p,--property", connect->options.properties, "KEY=VALUE (repeatable)")
        ->allow_extra_args(false);
    command->add_option("--name", connect->options.name, "name of the connection");
    run_when_chosen(command, selected, connect, rtm_connect);

    auto disconnect = std::make_shared<Running<DisconnectOptions>>();
    command = add_running_command(rtm, "disconnect",
                                  "Disconnects all connections of a port, or those between two ports",
                                  disconnect->client);
    command->add_option("PORT", disconnect->options.port, "port to disconnect")->required();
    command->add_option("OTHER", disconnect->options.other, "end only connections with this port (all)");
    command->add_option("--id", disconnect->options.id, "only the connection with this id");
    run_when_chosen(command, selected, disconnect, rtm_disconnect);
}

void add_conf(CLI::App& rtm, Action& selected) {
    auto options = std::make_shared<Running<ConfOptions>>();
    CLI::App* command =
        add_running_command(rtm, "conf", "Shows and sets configuration parameters", options->client,
                            "A component applies new values between two executions.");
    command->add_option("COMPONENT", options->options.component, "component, see below")->required();
    command->add_option("PARAMETER", options->options.values, "parameters to set, each as NAME=VALUE");
    command->add_option("--set", options->options.set,
                        "configuration set to show (all) or change (the active one)");
    command->add_option("--activate", options->options.activate, "configuration set to activate");
    run_when_chosen(command, selected, options, rtm_conf);
}

// The options of cat and inject.
using Stream = Running<StreamOptions>;

// allow_extra_args(false): otherwise CLI11 would take the words after --types FILE or -p KEY=VALUE as more
// values of that option, and PORT or VALUE would be missing.
CLI::App* add_stream(CLI::App& rtm, Stream& stream, const char* name, const char* brief,
                     const char* details) {
    CLI::App* command = add_running_command(rtm, name, brief, stream.client, details);
    command->add_option("PORT", stream.options.port, "COMPONENT:PORT")->required();
    command
        ->add_option("--types", stream.options.types,
                     "library of a component that defines its own data types (repeatable)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        ->add_option("-p,--property", stream.options.properties, "KEY=VALUE of the connection (repeatable)")
        ->allow_extra_args(false);
    add_endpoint(*command, stream.client);
    return command;
}

void add_streams(CLI::App& rtm, Action& selected) {
    auto cat = std::make_shared<Stream>();
    CLI::App* command =
        add_stream(rtm, *cat, "cat", "Prints the values that an OutPort sends, one line of JSON each",
                   "Values of unknown types are printed as CDR bytes.");
    command->add_option("-n,--count", cat->options.count, "end after this number of values");
    command->add_option("--for", cat->options.timeout_s, "end after this number of seconds")
        ->check(options::number_between(0.01, 1e6));
    command->add_flag("--raw", cat->options.raw, "always print CDR bytes");
    run_when_chosen(command, selected, cat, rtm_cat);

    auto inject = std::make_shared<Stream>();
    command = add_stream(
        rtm, *inject, "inject", "Sends values to an InPort",
        R"(VALUE is JSON, for example {"tm": {"sec": 1}, "data": [1, 2.5]}. A value without braces sets the
member data: `42` is a complete TimedLong. `-` reads one value from each line of standard input.)");
    // Not a std::vector: CLI11 would split [1,2] into two values. Values after the first one arrive as
    // extras.
    auto value = std::make_shared<std::string>();
    command->add_option("VALUE", *value, "value to send (repeatable)")->required();
    command->allow_extras();
    command->add_option("-n,--count", inject->options.count, "send all values this many times (1)");
    command
        ->add_option("--rate", inject->options.rate,
                     "values per second (as fast as the component reads them)")
        ->check(options::number_between(0., 1e6));
    command->callback([=, &selected] {
        inject->options.values = {*value};
        for (const auto& more : command->remaining()) {
            if (more.size() > 1 && more[0] == '-' && std::isdigit(static_cast<unsigned char>(more[1])) == 0)
                throw CLI::ExtrasError({more}); // a misspelt option, not a negative number
            inject->options.values.push_back(more);
        }
        selected = [inject] { return rtm_inject(inject->client, inject->options); };
    });
}

void add_record(CLI::App& rtm, Action& selected) {
    auto record = std::make_shared<Running<RtmRecordOptions>>();
    CLI::App* command = add_running_command(
        rtm, "record", "Records OutPorts to an MCAP file", record->client,
        R"(Use this for components without a link; for links, tandem record works without a connection. Each port
becomes a channel /COMPONENT/PORT with its type as IDL. Components do not wait for the recorder: their
host queues up to 1024 messages per port. The channel /tandem/drops counts messages dropped by the
recorder and by the queues of Tandem hosts; OpenRTM-aist does not report its own. Ends with Ctrl-C,
SIGTERM or SIGHUP. If the recorder is killed, the file is readable up to the last half second.)");
    command->add_option("PORT", record->options.ports,
                        "COMPONENT:PORT, or COMPONENT for all its OutPorts (all OutPorts)");
    command
        ->add_option("--types", record->options.types,
                     "library of a component that defines its own data types (repeatable)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        ->add_option("-p,--property", record->options.properties, "KEY=VALUE of the connections (repeatable)")
        ->allow_extra_args(false);
    add_endpoint(*command, record->client);
    add_recording_options(*command, record->options);
    run_when_chosen(command, selected, record, rtm_record);
}

// The monitor starts this command; users do not.
void add_requests(CLI::App& rtm, Action& selected) {
    auto options = std::make_shared<RtmClientOptions>();
    CLI::App* command = rtm.add_subcommand("requests", "For tandem monitor --control");
    command->group("");
    command->add_option("--timeout", options->timeout_s, "time limit for each call, in seconds (5)")
        ->check(options::number_between(0.1, 3600.));
    add_tls(*command, *options);
    command->callback([=, &selected] { selected = [options] { return rtm_requests(*options); }; });
}

} // namespace

void add_running_commands(CLI::App& rtm, Action& selected) {
    add_listings(rtm, selected);
    add_transitions(rtm, selected);
    add_connections(rtm, selected);
    add_conf(rtm, selected);
    add_streams(rtm, selected);
    add_record(rtm, selected);
    add_requests(rtm, selected);
}

} // namespace tandem::command
