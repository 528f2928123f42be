// SPDX-License-Identifier: Apache-2.0
#include "host/text/parse_number.hpp"

#include <clocale>
#include <cstdlib>

namespace tandem::text {

std::optional<double> parse_number(const std::string& text) {
    static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
    char* end = nullptr;
    const double number = strtod_l(text.c_str(), &end, classic);
    return end != text.c_str() && *end == '\0' ? std::optional(number) : std::nullopt;
}

} // namespace tandem::text
