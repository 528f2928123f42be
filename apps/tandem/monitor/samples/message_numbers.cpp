// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/samples/message_numbers.hpp"

#include <fmt/format.h>

#include <limits>

namespace tandem::monitor {
namespace {

using Json = nlohmann::ordered_json;

bool is_not_finite(const Json& value) {
    return value.is_string() && (value == "nan" || value == "-nan" || value == "inf" || value == "-inf");
}

void add(const Json& value, const std::string& name, MessageNumbers& numbers) {
    if (numbers.names.size() >= MessageNumbers::max_numbers) return;
    const auto add_number = [&](double number) {
        numbers.names.push_back(name.empty() ? "value" : name);
        numbers.values.push_back(number);
    };
    if (value.is_boolean()) return add_number(value.get<bool>() ? 1 : 0);
    if (value.is_number()) return add_number(value.get<double>());
    if (is_not_finite(value)) return add_number(std::numeric_limits<double>::quiet_NaN());
    if (value.is_array())
        for (std::size_t i = 0; i < value.size() && numbers.names.size() < MessageNumbers::max_numbers; ++i)
            add(value[i], fmt::format("{}[{}]", name, i), numbers);
    if (value.is_object())
        for (const auto& [key, member] : value.items())
            add(member, name.empty() ? key : fmt::format("{}.{}", name, key), numbers);
}

} // namespace

MessageNumbers numbers_of(const Json& message) {
    MessageNumbers numbers;
    add(message, "", numbers);
    return numbers;
}

} // namespace tandem::monitor
