// SPDX-License-Identifier: Apache-2.0
// The format of OpenRTM-aist's coil::Properties::load(), with bounds on the size. A line with neither `:` nor
// `=` is refused with its number here; OpenRTM-aist splits it at the first blank.
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <fstream>
#include <rtm/Manager.h>
#include <sstream>

namespace RTC {
namespace {

constexpr std::size_t max_bytes = 1 << 20, max_settings = 10000;

// Removes the backslash that continues a line. Returns false if there is none. An escaped backslash (`\\`) does not
// continue the line.
bool remove_continuation(std::string& line) {
    if (line.empty() || line.back() != '\\' || coil::isEscaped(line, line.size() - 1)) return false;
    line.pop_back();
    return true;
}

// The size is bounded because the file may not be a configuration, and a device or a pipe may be endless.
std::istringstream read_text(const std::filesystem::path& file) {
    std::error_code ignored;
    const auto type = std::filesystem::status(file, ignored).type();
    using Type = std::filesystem::file_type;
    if (type == Type::directory || type == Type::fifo || type == Type::socket)
        throw ManagerError(file.string() + ": cannot be read: not a regular file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ManagerError(file.string() + ": cannot be read; does it exist, and may you read it?");
    std::string text(max_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes)
        throw ManagerError(file.string() + ": not a configuration file: it has more than 1 MB");
    return std::istringstream(text);
}

// A NUL byte means that the file is encoded in UTF-16. Blanks are allowed: categories of components have them.
bool is_control(char c) { return static_cast<unsigned char>(c) < ' '; }

// Parses one logical line, `key: value` or `key = value`.
void parse_setting(const std::string& origin, const std::string& line, coil::Properties& out,
                   SettingOrigins* origins) {
    const std::size_t separator = line.find_first_of(":=");
    const std::string key = coil::eraseBothEndsBlank(line.substr(0, separator));
    if (separator == std::string::npos || key.empty() || std::any_of(key.begin(), key.end(), is_control))
        throw ManagerError(origin + ": expected `key: value`, found `" + printable(line) + "`");
    if (origins != nullptr) (*origins)[key] = origin;
    out.setProperty(key, coil::eraseBothEndsBlank(coil::unescape(line.substr(separator + 1))));
}

} // namespace

std::string printable(const std::string& text) {
    constexpr std::size_t max_shown = 60;
    std::string out;
    for (const char c : text.substr(0, max_shown))
        out += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return out + (text.size() > max_shown ? "..." : "");
}

void read_conf_file(const std::filesystem::path& file, coil::Properties& out, SettingOrigins* origins) {
    std::istringstream in = read_text(file);
    std::string logical_line; // physical lines joined by continuations
    int line_number = 0, first_line = 0;
    std::size_t settings = 0;
    while (in) {
        std::string line = coil::eraseHeadBlank(coil::getlinePortable(in));
        ++line_number;
        if (line_number == 1 && line.compare(0, 3, "\xef\xbb\xbf") == 0) line.erase(0, 3); // byte order mark
        if (logical_line.empty()) {
            if (line.empty() || line[0] == '#' || line[0] == '!') continue;
            first_line = line_number;
        }
        const bool continued = remove_continuation(line);
        logical_line += line;
        if (continued && in) continue;
        // Messages name the line at which the setting begins.
        const std::string origin = file.string() + ":" + std::to_string(first_line);
        if (++settings > max_settings)
            throw ManagerError(origin + ": more than " + std::to_string(max_settings) + " settings");
        parse_setting(origin, logical_line, out, origins);
        logical_line.clear();
    }
}

} // namespace RTC
