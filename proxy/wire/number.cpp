// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/number.hpp"

#include <cmath>
#include <limits>

namespace tandem::wire {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64);

/// Calls `use` with a value of the C++ type for this kind, and returns its result.
template <class Use>
auto with_type(Kind kind, Use&& use) {
    switch (kind) {
    case Kind::boolean:
        return use(false);
    case Kind::character:
        return use(static_cast<signed char>(0));
    case Kind::octet:
        return use(std::uint8_t{0});
    case Kind::int16:
        return use(std::int16_t{0});
    case Kind::uint16:
        return use(std::uint16_t{0});
    case Kind::int32:
        return use(std::int32_t{0});
    case Kind::int64:
        return use(std::int64_t{0});
    case Kind::uint64:
        return use(std::uint64_t{0});
    case Kind::float32:
        return use(0.0F);
    case Kind::float64:
        return use(0.0);
    case Kind::long_double:
        return use(0.0L);
    default:
        return use(std::uint32_t{0});
    }
}

} // namespace

bool is_number(Kind kind) { return primitive_size(kind) != 0; }

long double get_number(Kind kind, CdrReader& in) {
    return with_type(kind, [&]<class T>(T) -> long double {
        if constexpr (std::is_same_v<T, bool>)
            return in.get_bool() ? 1 : 0;
        else
            return static_cast<long double>(in.get<T>());
    });
}

bool put_number(Kind kind, long double value, CdrWriter& out) {
    return with_type(kind, [&]<class T>(T) -> bool {
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
    if (kind == Kind::uint64) return static_cast<std::int64_t>(in.get<std::uint64_t>());
    return static_cast<std::int64_t>(get_number(kind, in));
}

} // namespace tandem::wire
