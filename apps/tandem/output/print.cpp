// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"

#include "host/process/output_file.hpp"
#include "host/text/printable.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace tandem::command {
namespace {

/// Escapes the control characters that nlohmann::json leaves in strings: DEL, and U+0080 to U+009F.
std::string escape_c1(const std::string& json) {
    std::string out;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const auto next = i + 1 < json.size() ? static_cast<unsigned char>(json[i + 1]) : 0;
        if (json[i] == '\x7f')
            out += "\\u007f";
        else if (json[i] == '\xc2' && next < 0xa0)
            out += fmt::format("\\u{:04x}", static_cast<unsigned char>(json[++i]));
        else
            out += json[i];
    }
    return out;
}

} // namespace

void write_file(const std::filesystem::path& file, const std::string& text) {
    process::write_output(file, text);
}

void print_text(const std::string& text) { print_data(text::printable_text(text)); }

void print_data(const std::string& text) {
    // Only the flush shows whether buffered text has reached the file.
    if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        throw std::runtime_error(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void print_json(const nlohmann::json& value, bool one_line) {
    print_data(
        escape_c1(value.dump(one_line ? -1 : 2, ' ', false, nlohmann::json::error_handler_t::replace)) +
        "\n");
}

} // namespace tandem::command
