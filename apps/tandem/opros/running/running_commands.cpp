// SPDX-License-Identifier: Apache-2.0
// The command line of the `tandem opros` commands for running components.
#include "apps/tandem/opros/running/running_commands.hpp"

#include "apps/tandem/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {
namespace {

// The last lines of --help of each command that takes COMPONENT.
constexpr const char* names_of_components =
    R"(COMPONENT is the name of a component in the application of a running opros_host of this user. If several
hosts have it, write HOST/COMPONENT with the process id or the application of the host, see tandem opros list.
Exit code 1 if there is no such component, if the host refuses, or if it does not answer in time.)";

CLI::App* add_running_command(CLI::App& opros, const char* name, const char* brief,
                              OprosClientOptions& client, const std::string& details) {
    CLI::App* command = add_command(opros, name, brief, details);
    command->add_option("--timeout", client.timeout_s, "time limit for each request, in seconds (5)")
        ->check(options::number_between(0.1, 600.));
    command->add_flag("--json", client.json, "print JSON instead of text");
    return command;
}

// Adds a sub-command that takes components.
CLI::App* add_component_command(CLI::App& opros, const char* name, const char* brief,
                                OprosClientOptions& client, const std::string& details) {
    return add_running_command(opros, name, brief, client,
                               details + (details.empty() ? "" : "\n") + names_of_components);
}

void add_opros_list(CLI::App& opros, Action& selected) {
    auto options = std::make_shared<OprosClientOptions>();
    add_running_command(
        opros, "list", "Lists the components of running hosts, with their states", *options,
        "A host that does not answer is listed as UNREACHABLE. Exit code 1 if no host answers.")
        ->callback([=, &selected] { selected = [options] { return opros_list(*options); }; });
}

// start, stop and recover: the same command line for all three.
void add_opros_transitions(CLI::App& opros, Action& selected) {
    struct Options {
        OprosClientOptions client;
        std::vector<std::string> components;
    };
    auto add_transition = [&](const char* name, const char* brief, const char* details) {
        auto options = std::make_shared<Options>();
        CLI::App* command = add_component_command(opros, name, brief, options->client, details);
        command->add_option("COMPONENT", options->components, "components, see below")->required();
        command->callback([=, &selected, transition = std::string(name)] {
            selected = [=] { return opros_transition(options->client, options->components, transition); };
        });
    };
    add_transition("start", "Starts components and waits until they are ACTIVE",
                   "A component in ERROR must be recovered first.");
    add_transition("stop", "Stops components and waits until they are INACTIVE", "");
    add_transition("recover", "Recovers components from ERROR to READY",
                   "An AdaptorComp also resets the RTCs in ERROR behind its link.");
}

void add_opros_conf(CLI::App& opros, Action& selected) {
    struct Options {
        OprosClientOptions client;
        OprosConfOptions conf;
        std::string value;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_component_command(
        opros, "conf", "Shows properties of a component, and sets one", options->client,
        "The host sets the value between two cycles. Many components read a property only in their\n"
        "onInitialize or onStart.");
    command->add_option("COMPONENT", options->conf.component, "component, see below")->required();
    command->add_option("NAME", options->conf.name, "property to show or set (all); NAME=VALUE sets it, too");
    CLI::Option* value = command->add_option("VALUE", options->value, "value to set");
    command->callback([=, &selected] {
        if (value->count() != 0) options->conf.value = options->value;
        selected = [options] { return opros_conf(options->client, options->conf); };
    });
}

} // namespace

void add_running_opros_commands(CLI::App& opros, Action& selected) {
    add_opros_list(opros, selected);
    add_opros_transitions(opros, selected);
    add_opros_conf(opros, selected);
}

} // namespace tandem::command
