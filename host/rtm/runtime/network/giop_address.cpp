// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/giop_address.hpp"

namespace RTC {

GiopAddress parse_giop_address(const std::string& text) {
    const std::string unix_prefix = "giop:unix:", mapped_prefix = "::ffff:";
    if (text.compare(0, unix_prefix.size(), unix_prefix) == 0)
        return {"", "", text.substr(unix_prefix.size())};
    const std::size_t begin = text.find(':', text.find(':') + 1) + 1, colon = text.rfind(':');
    if (begin == 0 || colon < begin || colon == std::string::npos) return {};
    GiopAddress address{text.substr(begin, colon - begin), text.substr(colon + 1), ""};
    std::string& host = address.host;
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    if (host.compare(0, mapped_prefix.size(), mapped_prefix) == 0) host.erase(0, mapped_prefix.size());
    return address;
}

} // namespace RTC
