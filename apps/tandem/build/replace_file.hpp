// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// Prints a note if the file, which is about to be replaced, is tracked by git.
void tell_replaced(const std::filesystem::path& file);

/// Replaces a library that a running host may have loaded. Throws std::runtime_error if it cannot be written.
void replace_library(const std::filesystem::path& cmake_output, const std::filesystem::path& library);

} // namespace tandem::command
