// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tandem::link {

/// Numbers the types of the data ports with one name, from 0, in order of appearance. A port that is removed and
/// added again with another type gets other channels and another ring. Therefore no message of the old type, from a
/// late thread, reaches a reader of the new type. [one thread at a time]
class PortTypes {
  public:
    std::uint32_t number(const Port& port) {
        auto& types = types_[port.name];
        const Type type{port.kind, port.signature};
        const auto known = std::find(types.begin(), types.end(), type);
        const auto number = static_cast<std::uint32_t>(known - types.begin());
        if (known == types.end()) types.push_back(type);
        return number;
    }

  private:
    using Type = std::pair<PortKind, std::string>;
    std::map<std::string, std::vector<Type>> types_;
};

} // namespace tandem::link
