// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace tandem::monitor {

/// The numbers of one message, with their names such as `pose.x` or `data[2]`.
struct MessageNumbers {
    static constexpr std::size_t max_numbers = 64; ///< further numbers of a message are left out
    std::vector<std::string> names;
    std::vector<double> values; ///< a boolean is 0 or 1; infinity and NaN are NaN
};

/// Returns the numbers of a message as decoded by command::message_to_json().
MessageNumbers numbers_of(const nlohmann::ordered_json& message);

} // namespace tandem::monitor
