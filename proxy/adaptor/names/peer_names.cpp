// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/names/peer_names.hpp"

#include "proxy/adaptor/names/name_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tandem::adaptor {

PeerNames::PeerNames(const std::string& property, const std::string& text)
    : names_(read_name_pairs(property, text, "OPROS_NAME=RTC_NAME")) {}

bool PeerNames::is_of_another(const std::string& own) const {
    return names_.count(own) == 0 &&
           std::any_of(names_.begin(), names_.end(), [&](const auto& each) { return each.second == own; });
}

std::string suggest_names(const std::string& port, const std::vector<std::string>& fitting,
                          const std::string& pair) {
    if (fitting.empty()) return "";
    const bool one = fitting.size() == 1;
    return fmt::format("; {} {} its types: set AdaptorComp's property 'names.{}' to {} if {} meant",
                       fmt::join(fitting, ", "), one ? "has" : "have", port, pair,
                       one ? "it is" : "one of them is");
}

} // namespace tandem::adaptor
