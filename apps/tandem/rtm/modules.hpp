// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// A module that a library of RT-Components can be made of.
struct Module {
    std::string
        name; ///< of the library: X of XInit(), or the component's implementation_id beside rtc_init()
    std::string function;         ///< which the host calls
    std::filesystem::path source; ///< which has it; "" if only a header has been seen
};

/// The modules, by their names, that sources in the folder and its src/ define, or else those in other folders below it,
/// or else those that headers declare: functions XInit(RTC::Manager*) and rtc_init(RTC::Manager*). Sources with a main()
/// do not count, nor do comments, nor functions that are handed to setModuleInitProc(), as programs do.
std::vector<Module> find_modules(const std::filesystem::path& folder);

} // namespace tandem::command
