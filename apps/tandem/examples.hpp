// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace tandem::command {

/// Adds examples to the help of the sub-commands, as a section that help2man makes the section EXAMPLES of a man page.
/// Call it after all commands have been added.
void add_examples(CLI::App& tandem);

} // namespace tandem::command
