// SPDX-License-Identifier: Apache-2.0
#include "host/options/usage_error.hpp"

#include "host/text/nearest_name.hpp"
#include "host/text/printable.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace tandem::options {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
    std::vector<std::string> names;
    // CLI11 keeps option groups, which have no name, in the same list.
    for (const CLI::App* command :
         app.get_subcommands([](const CLI::App* each) { return !each->get_name().empty(); }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// CLI11 first reports what is missing, but an unknown argument explains the error better.
std::string reason(const CLI::App& app, const CLI::Error& error) {
    for (const std::string& argument : app.remaining()) {
        if (argument.size() > 1 && argument.front() == '-') {
            const std::string option = argument.substr(0, argument.find('='));
            return "there is no option " + option + text::did_you_mean(option, options_of(app));
        }
        if (const auto commands = commands_of(app); !commands.empty())
            return "there is no command '" + argument + "'" + text::did_you_mean(argument, commands);
    }
    if (!commands_of(app).empty() && error.get_name() == "RequiredError") return "a command is missing";
    return error.what();
}

} // namespace

std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    std::string command = std::filesystem::path(app->get_name()).filename().string();
    while (!app->get_subcommands().empty()) {
        app = app->get_subcommands().front();
        command += " " + app->get_name();
    }
    return text::printable_line(command + ": " + reason(*app, error) + "; see " + command + " --help") + "\n";
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
    app.failure_message(usage_error);
    try {
        app.parse(argc, argv);
        return std::nullopt;
    } catch (const CLI::ParseError& result) {
        return app.exit(result);
    }
}

} // namespace tandem::options
