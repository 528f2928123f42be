// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tandem::command {

/// What to do about an error of the compiler or the linker: the Debian package or the neighbour that has a missing
/// header or library, or why there is none. "" if nothing is known. `folder`: of the component.
std::string find_remedy(const std::string& error, const std::filesystem::path& folder);

/// The name that the linker does not find, according to its error; "" if it is another one.
std::string undefined_symbol(const std::string& error);

/// The name of OpenCV's C API that the compiler does not know, according to its error; "" if it is about another name.
std::string dropped_by_opencv(const std::string& error);

} // namespace tandem::command
