// SPDX-License-Identifier: Apache-2.0
// Names of files and folders that a shell, a generator or a terminal would act on if a program passed them on unquoted.
#pragma once

#include <string>
#include <vector>

namespace tandem::test {

/// Returns names without '/'. Each command in them creates the file `marker` in the current folder.
inline std::vector<std::string> nasty_names() {
    const std::string marker = "touch marker";
    const std::vector<std::string> parts{"$(" + marker + ")",
                                         "`" + marker + "`",
                                         ";" + marker + ";",
                                         "&" + marker + "&",
                                         "|" + marker + "|",
                                         "\n" + marker + "\n",
                                         "'; " + marker + "; '",
                                         "\"; " + marker + "; \"",
                                         "';system '" + marker + "'#",
                                         "\";system \"" + marker + "\"#",
                                         "'\n!" + marker + "\n",
                                         "$(shell " + marker + ")",
                                         ")\nexecute_process(COMMAND touch marker)\n#",
                                         "]==]\nexecute_process(COMMAND touch marker)\n#",
                                         "]=]\nexecute_process(COMMAND touch marker)\n#",
                                         "\"]; x [label=\"",
                                         "${HOME}",
                                         "$ENV{HOME}",
                                         "$HOME",
                                         "$$",
                                         "$<1:x>",
                                         ";",
                                         "'",
                                         "\"",
                                         "`",
                                         "\\",
                                         "\\\"",
                                         "\\'",
                                         "''",
                                         "#",
                                         "%",
                                         "%s%n",
                                         "{}",
                                         "{0}",
                                         "*",
                                         "?",
                                         "[a]",
                                         "~",
                                         "!",
                                         "&",
                                         "|",
                                         "<",
                                         ">",
                                         "(",
                                         ")",
                                         " ",
                                         "\t",
                                         "\n",
                                         "\r",
                                         "\x1b[31m",
                                         "\x1b]0;title\x07",
                                         "\xc2\x9b"
                                         "31m",
                                         "\x9b"
                                         "31m",
                                         "\xff\xfe",
                                         "\x7f",
                                         "\x01",
                                         "@",
                                         "^",
                                         ",",
                                         ":",
                                         "=",
                                         "+",
                                         "é",
                                         "日本"};
    std::vector<std::string> names{"-rf", "-",        "--",    "--help", "-I.", "-o",
                                   "-C",  "--output", "@file", "~root",  "..."};
    for (const std::string& part : parts) {
        names.push_back("a" + part + "b");
        names.push_back("a" + part);
        if (part != "~") names.push_back(part + "b");
    }
    return names;
}

} // namespace tandem::test
