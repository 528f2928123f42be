// SPDX-License-Identifier: Apache-2.0
#include "host/options/number_check.hpp"

#include "host/text/parse_number.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

namespace tandem::options {
namespace {

/// `expected` completes "Value X ..."; `shown` is what the help says about the value.
CLI::Validator check(const std::function<bool(double)>& accepts, const std::string& expected,
                     const std::string& shown) {
    return CLI::Validator(
        [accepts, expected](std::string& value) {
            const auto number = text::parse_number(value);
            return number && std::isfinite(*number) && accepts(*number) ? std::string()
                                                                        : "Value " + value + " " + expected;
        },
        shown);
}

} // namespace

CLI::Validator number_between(double min, double max) {
    return check([min, max](double number) { return number >= min && number <= max; },
                 fmt::format("not in range {:g} to {:g}", min, max),
                 fmt::format("FLOAT in [{:g} - {:g}]", min, max));
}

CLI::Validator positive_number() {
    return check([](double number) { return number > 0; }, "is not a positive number", "POSITIVE");
}

CLI::Validator nonnegative_number() {
    return check([](double number) { return number >= 0; }, "is not 0 or a positive number", "NONNEGATIVE");
}

} // namespace tandem::options
