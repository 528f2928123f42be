// SPDX-License-Identifier: Apache-2.0
#include "host/options/usage_error.hpp"

#include "host/text/nearest_name.hpp"
#include "host/text/printable.hpp"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
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

/// Returns a text of CLI11 with readable limits of a range: CLI11 writes those of a double with up to 309 digits.
std::string with_short_limits(const std::string& text) {
    static const std::regex range(R"(not in range (-?[0-9.]+) to ([0-9.]+))");
    std::smatch found;
    if (!std::regex_search(text, found, range)) return text;
    constexpr std::ptrdiff_t longest = 20; // digits of any limit that an option has
    std::string limits = "is not a positive number";
    if (found[2].length() <= longest) {
        std::ostringstream out;
        out.precision(longest / 2);
        out << "not in range " << std::strtod(found.str(1).c_str(), nullptr) << " to "
            << std::strtod(found.str(2).c_str(), nullptr);
        limits = out.str();
    }
    return found.prefix().str() + limits + found.suffix().str();
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
    return with_short_limits(error.what());
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

} // namespace tandem::options
