// SPDX-License-Identifier: Apache-2.0
#include "host/log/log.hpp"

#include "host/text/printable.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace tandem::log {

void open(const std::string& program, const std::string& pattern) {
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>(program, std::make_shared<spdlog::sinks::stderr_sink_mt>()));
    if (!pattern.empty()) spdlog::set_pattern(pattern);
}

void write_errors_only() { spdlog::set_level(spdlog::level::err); }

void error(std::string_view line) { spdlog::error(text::printable_text(line)); }
void warn(std::string_view line) { spdlog::warn(text::printable_text(line)); }
void info(std::string_view line) { spdlog::info(text::printable_text(line)); }

} // namespace tandem::log
