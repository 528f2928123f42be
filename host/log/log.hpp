// SPDX-License-Identifier: Apache-2.0
// The log of the host. spdlog writes it, but a file that logs does not compile spdlog's templates.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace tandem::log {

/// Makes standard error the log of this process, in the format of OpenRTM-aist: `[date time] [level] program: message`.
/// Call it once, before other threads log. Logging then never waits for a reader: lines that do not fit into its pipe are
/// counted, and the log says how many are missing when it can be written again.
void open(const std::string& program);

/// Writes a line to the log unchanged. Before open(), writes it to standard error. Does not throw. [any-thread]
void print(std::string_view line);

/// Reports lines that are missing, if the log can be written again. Does not throw. [any-thread]
void flush();

/// Restricts the log to errors from now on.
void write_errors_only();

/// Logs one line at the level that the function names, with '?' for control characters, because the line may quote
/// text from outside. Does not throw. [any-thread]
void error(std::string_view line);
void warn(std::string_view line);
void info(std::string_view line);

/// Formats a line with fmt and logs it at the level that the function names.
template <typename... Args>
void error(fmt::format_string<Args...> text, Args&&... args) {
    error(std::string_view(fmt::vformat(text, fmt::make_format_args(args...))));
}
template <typename... Args>
void warn(fmt::format_string<Args...> text, Args&&... args) {
    warn(std::string_view(fmt::vformat(text, fmt::make_format_args(args...))));
}
template <typename... Args>
void info(fmt::format_string<Args...> text, Args&&... args) {
    info(std::string_view(fmt::vformat(text, fmt::make_format_args(args...))));
}

} // namespace tandem::log
