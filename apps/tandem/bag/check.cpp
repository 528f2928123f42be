// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/commands.hpp"
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"

namespace tandem::command {

int bag_check(const std::filesystem::path& file) {
    std::string text;
    bool errors = false;
    for (const auto& finding : mcap::check_file(file)) {
        text += (finding.error ? "error: " : "warning: ") + replace_control_characters(finding.line) + "\n";
        errors = errors || finding.error;
    }
    if (!errors) text += file.string() + ": no errors\n";
    print_text(text);
    return errors ? 1 : 0;
}

} // namespace tandem::command
