// SPDX-License-Identifier: Apache-2.0
// Names that sources get from the headers of Windows.
#pragma once

#include <map>
#include <string>

namespace tandem::command {

/// Returns the declarations of simple names such as BOOL that a compiler's output reports as unknown, by name.
std::map<std::string, std::string> missing_windows_names(const std::string& output);

/// Returns whether only Windows has the function or type, for example GetTickCount.
bool is_windows_name(const std::string& name);

} // namespace tandem::command
