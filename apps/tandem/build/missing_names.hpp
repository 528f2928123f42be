// SPDX-License-Identifier: Apache-2.0
// Names that sources expect from headers of Windows, or from standard headers that others included.
#pragma once

#include <map>
#include <string>

namespace tandem::command {

/// Returns lines to compile before a source, by what it lacks according to the compiler's output: declarations of simple
/// names of Windows such as BOOL, and standard headers.
std::map<std::string, std::string> missing_names(const std::string& output);

/// Returns whether only Windows has the function or type, for example GetTickCount.
bool is_windows_name(const std::string& name);

} // namespace tandem::command
