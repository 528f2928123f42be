// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace tandem::command {

/// Names of the modules that sources in the folder, its src/ and include/ define, or else those in other folders below
/// it: X for each function XInit(RTC::Manager*). Sources with a main() do not count, nor do comments.
std::set<std::string> find_module_names(const std::filesystem::path& folder);

} // namespace tandem::command
