// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/number.hpp"

#include "proxy/wire/visit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace tandem::wire {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64);

} // namespace

bool is_number(Kind kind) { return primitive_size(kind) != 0; }

long double get_number(Kind kind, CdrReader& in) {
    return visit_number(kind, 0.0L, [&]<class T>(T) -> long double {
        if constexpr (std::is_same_v<T, bool>)
            return in.get_bool() ? 1 : 0;
        else
            return static_cast<long double>(in.get<T>());
    });
}

bool put_number(Kind kind, long double value, CdrWriter& out) {
    return visit_number(kind, false, [&]<class T>(T) -> bool {
        if constexpr (std::is_floating_point_v<T>) {
            out.put(static_cast<T>(value));
            return !std::isfinite(value) || std::isfinite(static_cast<T>(value));
        } else {
            const long double rounded = std::nearbyint(value);
            const bool fits = rounded >= static_cast<long double>(std::numeric_limits<T>::min()) &&
                              rounded <= static_cast<long double>(std::numeric_limits<T>::max());
            const T number = fits ? static_cast<T>(rounded) : T{};
            if constexpr (std::is_same_v<T, bool>)
                out.put_bool(number);
            else
                out.put(number);
            return fits;
        }
    });
}

bool is_fixed(std::string_view text, const Type& fixed) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const auto point = std::min(text.find('.'), text.size());
    const auto whole = text.substr(0, point), fraction = text.substr(std::min(point + 1, text.size()));
    const auto all_digits = [](std::string_view part) {
        return part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    const auto before = whole.size() - std::min(whole.find_first_not_of('0'), whole.size());
    const auto behind = fraction.find_last_not_of('0') + 1; // 0 if there is no other digit
    return !(whole.empty() && fraction.empty()) && all_digits(whole) && all_digits(fraction) &&
           before <= fixed.count - fixed.scale && behind <= fixed.scale;
}

std::string why_not_fixed(std::string_view text, const Type& fixed) {
    return fmt::format("is '{}': expected a decimal number of at most {} digits, {} after the point",
                       text.substr(0, 40), fixed.count, fixed.scale);
}

std::int64_t get_integer(Kind kind, CdrReader& in) {
    return visit_number(kind, std::int64_t{0}, [&]<class T>(T) {
        if constexpr (std::is_same_v<T, bool>)
            return std::int64_t{in.get_bool()};
        else
            return static_cast<std::int64_t>(in.get<T>());
    });
}

} // namespace tandem::wire
