// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem bag`, one source file each. Each function prints its result and returns the
// exit code. Each throws std::runtime_error with a one-line message. A damaged recording is used as far as it can be
// read; then the exit code is 1 and one line on standard error says what is lost.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Prints what a recording contains.
int bag_info(const std::filesystem::path& file, bool json);

/// Options of `tandem bag cut`.
struct BagCutOptions {
    std::filesystem::path file, out;
    std::string from, to;            ///< seconds from the start, or RFC 3339; empty: no limit
    std::vector<std::string> topics; ///< empty: all topics
};
/// Writes a part of a recording to a new file.
int bag_cut(const BagCutOptions& options);

/// Options of `tandem bag convert`.
struct BagConvertOptions {
    std::filesystem::path file, out; ///< `out` empty: standard output
    bool csv = false, json = false;  ///< either a table, or a line of JSON for each message
    std::vector<std::string> topics; ///< empty: all ports
};
/// Writes the messages of ports as text, with the names of their members.
int bag_convert(const BagConvertOptions& options);

/// Prints the errors and warnings in a recording, one per line. Returns 1 if there is an error.
int bag_check(const std::filesystem::path& file);

} // namespace tandem::command
