// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tandem::command {

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text << std::flush; // only the flush detects a full disk
    if (!stream) throw std::runtime_error(file.string() + " cannot be written: " + std::strerror(errno));
}

void print_text(const std::string& text) {
    // Only the flush shows whether buffered text has reached the file.
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw std::runtime_error(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void print_json(const nlohmann::json& value, bool one_line) {
    print_text(value.dump(one_line ? -1 : 2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

} // namespace tandem::command
