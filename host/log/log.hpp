// SPDX-License-Identifier: Apache-2.0
// The log of the host, which spdlog writes. A file that logs does not compile the templates of spdlog.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace tandem::log {

/// Makes standard error the log of this process, each line in `pattern` (of spdlog) or, if that is empty, in spdlog's own.
/// To be called once, before other threads log.
void open(const std::string& program, const std::string& pattern = {});

/// From now on only errors are written.
void write_errors_only();

/// One line at the level that the function names. Any thread. Does not throw.
void error(std::string_view line);
void warn(std::string_view line);
void info(std::string_view line);

/// The same for a format string of fmt and its arguments.
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
