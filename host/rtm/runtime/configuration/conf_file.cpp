// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <fstream>
#include <rtm/Manager.h>
#include <sstream>

namespace RTC {
namespace {

bool continues(std::string& line) {
    if (line.empty() || line.back() != '\\' || coil::isEscaped(line, line.size() - 1)) return false;
    line.pop_back();
    return true;
}

constexpr std::size_t most_bytes = 1 << 20, most_settings = 10000;

// Nobody writes more than that by hand, and what is no text need not have an end: a device, a pipe.
std::istringstream contents(const std::filesystem::path& file) {
    std::error_code none;
    const auto kind = std::filesystem::status(file, none).type();
    using Kind = std::filesystem::file_type;
    if (kind == Kind::directory || kind == Kind::fifo || kind == Kind::socket)
        throw ManagerError(file.string() + ": cannot be read: it is no file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ManagerError(file.string() + ": cannot be read");
    std::string text(most_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > most_bytes)
        throw ManagerError(file.string() + ": is no configuration: it has more than 1 MB");
    return std::istringstream(text);
}

// Blanks, and the zeros of a text in 16 bits.
bool is_no_part_of_key(char c) { return static_cast<unsigned char>(c) <= ' '; }

void take(const std::string& place, const std::string& text, coil::Properties& out, SettingOrigins* places) {
    const std::size_t at = text.find_first_of(":=");
    const std::string key = coil::eraseBothEndsBlank(text.substr(0, at));
    if (at == std::string::npos || key.empty() || std::any_of(key.begin(), key.end(), is_no_part_of_key))
        throw ManagerError(place + ": expected `key: value`, found `" + printable(text) + "`");
    if (places != nullptr) (*places)[key] = place;
    out.setProperty(key, coil::eraseBothEndsBlank(coil::unescape(text.substr(at + 1))));
}

} // namespace

std::string printable(const std::string& text) {
    std::string out;
    for (const char c : text.substr(0, 60)) out += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return out + (text.size() > 60 ? "..." : "");
}

void read_conf_file(const std::filesystem::path& file, coil::Properties& out, SettingOrigins* places) {
    std::istringstream in = contents(file);
    std::string text;
    int line_number = 0, begun_at = 0;
    std::size_t settings = 0;
    while (in) {
        std::string line = coil::eraseHeadBlank(coil::getlinePortable(in));
        ++line_number;
        if (line_number == 1 && line.compare(0, 3, "\xef\xbb\xbf") == 0) line.erase(0, 3); // byte order mark
        if (text.empty()) {
            if (line.empty() || line[0] == '#' || line[0] == '!') continue;
            begun_at = line_number;
        }
        const bool more = continues(line);
        text += line;
        if (more && in) continue;
        const std::string place = file.string() + ":" + std::to_string(begun_at);
        if (++settings > most_settings)
            throw ManagerError(place + ": more than " + std::to_string(most_settings) + " settings");
        take(place, text, out, places);
        text.clear();
    }
}

} // namespace RTC
