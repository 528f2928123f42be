// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// A module of RT-Components, to be built as a library.
struct Module {
    std::string name;     ///< library name: X of XInit(), or the component's implementation_id for rtc_init()
    std::string function; ///< function that the host calls
    std::filesystem::path source; ///< file that defines it; "" if only a header was found
};

/// Returns the modules, by name: functions XInit(RTC::Manager*) and rtc_init(RTC::Manager*). Searches the folder, src/
/// and include/, and without success all folders below. Declarations in headers count only if no source defines a
/// module. Ignores comments, sources with a main(), and functions passed to setModuleInitProc().
std::vector<Module> find_modules(const std::filesystem::path& folder);

} // namespace tandem::command
