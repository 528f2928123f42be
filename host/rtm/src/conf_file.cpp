// SPDX-License-Identifier: Apache-2.0
#include "conf_file.hpp"
#include <coil/stringutil.h>
#include <fstream>
#include <rtm/Manager.h>

namespace RTC {
namespace {

bool continues(std::string& line) {
    if (line.empty() || line.back() != '\\' || coil::isEscaped(line, line.size() - 1)) return false;
    line.pop_back();
    return true;
}

void take(const std::string& place, const std::string& text, coil::Properties& out, Places* places) {
    const std::size_t at = text.find_first_of(":=");
    const std::string key = coil::eraseBothEndsBlank(text.substr(0, at));
    if (at == std::string::npos || key.empty() || key.find_first_of(" \t") != std::string::npos)
        throw ManagerError(place + ": expected `key: value`, found `" + text + "`");
    if (places != nullptr) (*places)[key] = place;
    out.setProperty(key, coil::eraseBothEndsBlank(coil::unescape(text.substr(at + 1))));
}

} // namespace

void read_conf_file(const std::filesystem::path& file, coil::Properties& out, Places* places) {
    std::ifstream in(file);
    if (!in) throw ManagerError(file.string() + ": cannot be read");
    std::string text;
    int line_number = 0, begun_at = 0;
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
        take(file.string() + ":" + std::to_string(begun_at), text, out, places);
        text.clear();
    }
}

} // namespace RTC
