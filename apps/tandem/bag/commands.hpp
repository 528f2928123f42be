// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem bag`, a source file each. Each prints its result, returns the exit code, and throws
// std::runtime_error with one line.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// What a recording contains. 0 also for an incomplete one.
int bag_info(const std::filesystem::path& file, bool json);

/// Of cut.
struct BagCutOptions {
    std::filesystem::path file, out;
    std::string from, to;            ///< seconds from the begin, or RFC 3339; empty: the whole
    std::vector<std::string> topics; ///< empty: all
};
/// Writes a part of a recording to a new file.
int bag_cut(const BagCutOptions& options);

/// Of convert.
struct BagConvertOptions {
    std::filesystem::path file, out; ///< no `out`: standard output
    bool csv = false, json = false;  ///< one of them: a table, or a line of JSON for each message
    std::vector<std::string> topics; ///< empty: all ports
};
/// Writes the messages of ports as text, by the names of their members.
int bag_convert(const BagConvertOptions& options);

/// What is wrong with a recording, a line each. 1 if anything is.
int bag_check(const std::filesystem::path& file);

} // namespace tandem::command
