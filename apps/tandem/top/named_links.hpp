// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {

/// Throws std::runtime_error with one line if one of these links does not exist.
inline void require_links(const monitor::State& state, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (std::none_of(state.links.begin(), state.links.end(),
                         [&](const auto& link) { return link.name == name; }))
            throw std::runtime_error(
                fmt::format("link '{}' does not exist; tandem shm list shows existing links", name));
}

} // namespace tandem::command
