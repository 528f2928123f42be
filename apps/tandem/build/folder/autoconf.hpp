// SPDX-License-Identifier: Apache-2.0
// Reads what a configure script would define. The script is not run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Returns NAME=VALUE for the macros that a configure.ac (or configure.in) defines on every machine: AC_DEFINE() outside of
/// conditions, and the names and versions of AC_INIT() and AM_INIT_AUTOMAKE().
std::vector<std::string> read_autoconf_definitions(const std::filesystem::path& configure_ac);

} // namespace tandem::command
