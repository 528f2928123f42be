// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/number.hpp"

#include "proxy/wire/visit.hpp"

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

std::int64_t get_integer(Kind kind, CdrReader& in) {
    return visit_number(kind, std::int64_t{0}, [&]<class T>(T) {
        if constexpr (std::is_same_v<T, bool>)
            return std::int64_t{in.get_bool()};
        else
            return static_cast<std::int64_t>(in.get<T>());
    });
}

} // namespace tandem::wire
