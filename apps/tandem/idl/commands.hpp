// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct Idl2OprosOptions {
    std::filesystem::path file, folder = ".";
    std::vector<std::string> include_dirs;
};
/// Runs omniidl with Tandem's back end. Throws std::runtime_error with omniidl's first error.
int idl2opros(const Idl2OprosOptions& options);

struct Opros2IdlOptions {
    std::filesystem::path file, output; ///< `output` empty: standard output
    std::vector<std::string> type_files;
};
/// Throws std::runtime_error with file and line if a profile is wrong or a type is unknown.
int opros2idl(const Opros2IdlOptions& options);

} // namespace tandem::command
