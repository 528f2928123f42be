// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem rtm` for components that run.
#include "apps/tandem/rtm/running/running.hpp"

#include <cctype>
#include <memory>

namespace tandem::command {
namespace {

using Chosen = std::function<int()>;
constexpr const char* addresses =
    "COMPONENT is rtcname://HOST:PORT/PATH/NAME.rtc (a name server), rtcloc://HOST:PORT/NAME (a manager), a\n"
    "path PATH/NAME.rtc in the default name server, or NAME alone: then the name servers and this user's\n"
    "managers on this machine are searched; with --nameserver or --manager only these, which must answer.\n"
    "A port is COMPONENT:PORT.\n"
    "Exit code 1, with one line, when something is not there or does not answer in time.";

CLI::App* add(CLI::App& rtm, const char* name, const char* brief, PeerOptions& peers,
              const std::string& details = "") {
    CLI::App* command = rtm.add_subcommand(name, brief);
    command->footer(details + (details.empty() ? "" : "\n") + addresses);
    command
        ->add_option("--nameserver", peers.name_servers,
                     "HOST or HOST:PORT of a name server (repeatable; $RTCSH_NAMESERVERS, else localhost)")
        ->allow_extra_args(false);
    command->add_option("--manager", peers.managers, "HOST:PORT of a manager (repeatable; those found here)")
        ->allow_extra_args(false);
    command->add_option("--timeout", peers.seconds, "seconds that a call may take (5)")
        ->check(CLI::Range(0.1, 3600.));
    command->add_flag("--json", peers.json, "print JSON instead of text");
    return command;
}

void add_looks(CLI::App& rtm, Chosen& chosen) {
    auto list = std::make_shared<PeerOptions>();
    add(rtm, "list", "The components that run, here and in name servers", *list,
        "A name whose component does not answer is listed as UNREACHABLE.")
        ->callback([=, &chosen] { chosen = [list] { return rtm_list(*list); }; });
    auto tree = std::make_shared<PeerOptions>();
    add(rtm, "tree", "The same with ports and what they are connected with", *tree)->callback([=, &chosen] {
        chosen = [tree] { return rtm_tree(*tree); };
    });
    struct Info {
        PeerOptions peers;
        std::string component;
    };
    auto info = std::make_shared<Info>();
    CLI::App* command =
        add(rtm, "info", "What a component is: profile, contexts, ports, connections", info->peers);
    command->add_option("COMPONENT", info->component, "which one")->required();
    command->callback([=, &chosen] { chosen = [info] { return rtm_info(info->peers, info->component); }; });
}

void add_transitions(CLI::App& rtm, Chosen& chosen) {
    struct Options {
        PeerOptions peers;
        std::vector<std::string> components;
    };
    auto one = [&](const char* name, const char* brief, Transition transition) {
        auto options = std::make_shared<Options>();
        CLI::App* command = add(rtm, name, brief, options->peers);
        command->add_option("COMPONENT", options->components, "which ones")->required();
        command->callback([=, &chosen] {
            chosen = [=] { return rtm_transition(options->peers, options->components, transition); };
        });
    };
    one("activate", "Makes components active, and waits for it", Transition::activate);
    one("deactivate", "Makes components inactive, and waits for it", Transition::deactivate);
    one("reset", "Brings components from ERROR to INACTIVE", Transition::reset);
    one("exit", "Ends components", Transition::exit);
}

void add_connections(CLI::App& rtm, Chosen& chosen) {
    struct Connect {
        PeerOptions peers;
        ConnectOptions what;
    };
    auto connect = std::make_shared<Connect>();
    CLI::App* command = add(rtm, "connect", "Connects the first port with each of the others", connect->peers,
                            "Properties are those of manager.components.preconnect: dataflow_type=pull, "
                            "subscription_type=new ...");
    command->add_option("PORT", connect->what.ports, "two ports or more")->required()->expected(2, -1);
    command->add_option("-p,--property", connect->what.properties, "KEY=VALUE (repeatable)")
        ->allow_extra_args(false);
    command->add_option("--name", connect->what.name, "name of the connection");
    command->callback(
        [=, &chosen] { chosen = [connect] { return rtm_connect(connect->peers, connect->what); }; });

    struct Disconnect {
        PeerOptions peers;
        DisconnectOptions what;
    };
    auto end = std::make_shared<Disconnect>();
    command = add(rtm, "disconnect", "Ends the connections of a port, or those between two", end->peers);
    command->add_option("PORT", end->what.ports, "one port or two")->required()->expected(1, 2);
    command->add_option("--id", end->what.id, "only the connection with this id");
    command->callback([=, &chosen] { chosen = [end] { return rtm_disconnect(end->peers, end->what); }; });
}

void add_conf(CLI::App& rtm, Chosen& chosen) {
    struct Options {
        PeerOptions peers;
        ConfOptions what;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add(rtm, "conf", "Shows and sets configuration parameters", options->peers,
                            "A component takes a new value over between two executions.");
    command->add_option("COMPONENT", options->what.component, "which one")->required();
    command->add_option("NAME=VALUE", options->what.values, "parameters to set");
    command->add_option("--set", options->what.set, "configuration set (the active one)");
    command->add_option("--activate", options->what.activate, "configuration set to make the active one");
    command->callback(
        [=, &chosen] { chosen = [options] { return rtm_conf(options->peers, options->what); }; });
}

struct Stream {
    PeerOptions peers;
    StreamOptions what;
};

CLI::App* add_stream(CLI::App& rtm, Stream& stream, const char* name, const char* brief,
                     const char* details) {
    CLI::App* command = add(rtm, name, brief, stream.peers, details);
    command->add_option("PORT", stream.what.port, "which one")->required();
    command
        ->add_option("--types", stream.what.types,
                     "library of a component, for its own data types (repeatable)")
        ->allow_extra_args(false);
    command->add_option("-p,--property", stream.what.properties, "KEY=VALUE of the connection (repeatable)")
        ->allow_extra_args(false);
    return command;
}

void add_streams(CLI::App& rtm, Chosen& chosen) {
    auto cat = std::make_shared<Stream>();
    CLI::App* command = add_stream(rtm, *cat, "cat", "Prints what an OutPort sends, one line of JSON each",
                                   "A type that is not known is printed as the bytes of its CDR form.");
    command->add_option("-n,--count", cat->what.count, "leave after so many samples");
    command->add_option("--for", cat->what.seconds, "leave after so many seconds")
        ->check(CLI::Range(0.01, 1e6));
    command->add_flag("--raw", cat->what.raw, "print bytes in any case");
    command->callback([=, &chosen] { chosen = [cat] { return rtm_cat(cat->peers, cat->what); }; });

    auto inject = std::make_shared<Stream>();
    command = add_stream(
        rtm, *inject, "inject", "Sends values to an InPort",
        "VALUE is JSON: {\"tm\": {\"sec\": 1}, \"data\": [1, 2.5]}; a plain one stands for data, so\n"
        "`42` will do for a TimedLong; `-` reads one value from each line of standard input.");
    // Not a list for the parser: it would take [1,2] apart.
    auto value = std::make_shared<std::string>();
    command->add_option("VALUE", *value, "what to send; more may follow")->required();
    command->allow_extras();
    command->add_option("-n,--count", inject->what.count, "send all so many times (1)");
    command->add_option("--rate", inject->what.rate, "values per second (at once)")
        ->check(CLI::Range(0., 1e6));
    command->callback([=, &chosen] {
        inject->what.values = {*value};
        for (const auto& more : command->remaining()) {
            if (more.size() > 1 && more[0] == '-' && std::isdigit(static_cast<unsigned char>(more[1])) == 0)
                throw CLI::ExtrasError({more});
            inject->what.values.push_back(more);
        }
        chosen = [inject] { return rtm_inject(inject->peers, inject->what); };
    });
}

} // namespace

void add_running(CLI::App& rtm, Chosen& chosen) {
    add_looks(rtm, chosen);
    add_transitions(rtm, chosen);
    add_connections(rtm, chosen);
    add_conf(rtm, chosen);
    add_streams(rtm, chosen);
}

} // namespace tandem::command
