// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/commands.hpp"
#include "apps/tandem/output/print.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

/// Returns the second word of "tandem opros conf": the group of a command.
std::string group_of(const std::string& path) {
    const std::string below = path.substr(std::min(path.size(), path.find(' ') + 1));
    return below.substr(0, below.find(' '));
}

/// What completes an argument of the command `path`, as a command of bash that fills COMPREPLY; empty if nothing does.
std::string candidates(const CLI::Option& option, const std::string& path) {
    // "FILE", "TEXT", or with the descriptions of validators "INT:{11,14,17}".
    const std::string type = option.get_type_name();
    const std::string kind = type.substr(0, type.find(':'));
    const std::string name = option.get_positional() ? option.get_name(true) : "";
    if (kind == "FILE" || name == "FILE") return "_tandem_files -f";
    if (kind == "DIR" || name == "DIR") return "_tandem_files -d";
    if (kind == "LINK" || name == "LINK") return "_tandem_links";
    if (name == "COMPONENT") return "_tandem_components " + group_of(path); // listed by `tandem GROUP list`
    const std::size_t begin = type.find('{'), end = type.find('}');
    if (begin == std::string::npos || end == std::string::npos) return "";
    std::string words = type.substr(begin + 1, end - begin - 1);
    std::replace(words.begin(), words.end(), ',', ' ');
    return "_tandem_words '" + words + "'";
}

// Flags expect no item.
bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

// Long names first: they are what most users complete.
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const auto& name : option.get_lnames()) names.push_back("--" + name);
    for (const auto& name : option.get_snames()) names.push_back("-" + name);
    return names;
}

// CLI11 keeps option groups in the same list: they have no name.
std::vector<const CLI::App*> subcommands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

/// The branches of the three `case` statements in the script, gathered for a command and all below it.
struct Branches {
    std::string descend; ///< "command word": the word selects a sub-command, or is an option with a value
    std::string values;  ///< "command option": completes the option's value
    std::string words;   ///< "command": its options, sub-commands and positional arguments

    /// `path` is the command with the commands above it: "tandem shm info".
    void add(const CLI::App& app, const std::string& path) {
        std::string options, subcommands, positional;
        for (const CLI::Option* option : app.get_options()) {
            // Only the first positional argument that can be completed: the script does not count arguments.
            if (option->get_positional() && positional.empty()) positional = candidates(*option, path);
            for (const auto& name : names_of(*option)) {
                options += (options.empty() ? "" : " ") + name;
                if (!takes_value(*option)) continue;
                descend += fmt::format("            '{} {}') ((++i)) ;;\n", path, name);
                const std::string completes = candidates(*option, path);
                values += fmt::format("        '{} {}') {} return ;;\n", path, name,
                                      completes.empty() ? "" : completes + ";");
            }
        }
        for (const CLI::App* sub : subcommands_of(app)) {
            const std::string below = path + " " + sub->get_name();
            subcommands += (subcommands.empty() ? "" : " ") + sub->get_name();
            descend += fmt::format("            '{0}') command='{0}' ;;\n", below);
            add(*sub, below);
        }
        words += fmt::format("        '{}') options='{}' subcommands='{}' positional=\"{}\" ;;\n", path,
                             options, subcommands, positional);
    }
};

// The names of links and of components come from other users' files in /dev/shm. The shell must not expand them, so only
// names made of a link's characters are offered.
// `command` becomes the path of sub-commands that the words before the cursor name. bash splits at '=', so --option=value
// comes as three words. compgen gives one candidate per line, because a file name may contain blanks.
constexpr char script[] =
    R"(# bash completion for @NAME@, written by `@NAME@ completion bash` from the program's own options.
_tandem_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}
_tandem_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen "$1" -- "$current")
}
_tandem_links() {
    local file links=
    for file in /dev/shm/tandem.*.*; do
        file=${file#/dev/shm/tandem.}
        [[ -r /dev/shm/tandem.$file && $file != -* && ${file%.*} != *[!A-Za-z0-9_-]* ]] || continue
        [[ " $links " == *" ${file%.*} "* ]] || links+=" ${file%.*}"
    done
    _tandem_words "$links"
}
_tandem_components() {
    local name rest components=
    while read -r name rest; do
        [[ $name != - && $name != *[!A-Za-z0-9_.-]* ]] && components+=" $name"
    done < <(@NAME@ "$1" list --timeout 1 2>/dev/null | tail -n +2)
    _tandem_words "$components"
}
_@NAME@() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
    local command='@NAME@' options= subcommands= positional= i
    COMPREPLY=()
    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD-2]}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case "$command ${COMP_WORDS[i]}" in
@DESCEND@        esac
    done
    case "$command $previous" in
@VALUES@    esac
    case "$command" in
@WORDS@    esac
    if [[ $current == -* ]]; then
        _tandem_words "$options"
    elif [[ $subcommands ]]; then
        _tandem_words "$subcommands"
    elif [[ $positional ]]; then
        eval "$positional"
    elif [[ ! $current ]]; then
        _tandem_words "$options"
    fi
}
complete -F _@NAME@ @NAME@
)";

/// Returns a script for bash that completes the command line of `app`: sub-commands, options, and their values where these
/// are files, folders, links, components or one of a fixed set. Everything in it comes from the tree of CLI::App, so that a
/// new command or option is completed without further work. The type name or, for a positional argument, the name says what
/// it is: FILE, DIR, LINK or COMPONENT; a fixed set is a CLI::IsMember. The script defines and registers _<name>.
std::string bash_completion_script(const CLI::App& app) {
    Branches branches;
    branches.add(app, app.get_name());
    std::string text = script;
    boost::replace_all(text, "@NAME@", app.get_name());
    boost::replace_all(text, "@DESCEND@", branches.descend);
    boost::replace_all(text, "@VALUES@", branches.values);
    boost::replace_all(text, "@WORDS@", branches.words);
    return text;
}

} // namespace

void add_completion_command(CLI::App& tandem, Action& selected) {
    CLI::App* command = tandem.add_subcommand(
        "completion", "Prints a script that lets a shell complete tandem's commands and options");
    command->footer("Tandem installs the script for bash as share/bash-completion/completions/tandem. In a "
                    "shell that does\n"
                    "not read that folder, run:  source <(tandem completion bash)");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "the shell")->required()->check(CLI::IsMember({"bash"}));
    // Walks the tree when the command runs, because only then all commands have been added.
    command->callback([&tandem, &selected, shell] {
        selected = [&tandem] {
            print_data(bash_completion_script(tandem));
            return 0;
        };
    });
}

} // namespace tandem::command
