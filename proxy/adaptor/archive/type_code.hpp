// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace tandem::adaptor {

/// Returns the type code of an OPRoS primitive. `long` has the code of its size, because both hosts run on one machine and
/// the same source must mean the same on both.
template <class T>
constexpr char code_of() {
    if constexpr (std::is_same_v<T, bool>)
        return 'b';
    else if constexpr (std::is_same_v<T, unsigned char>)
        return 'y';
    else if constexpr (std::is_same_v<T, wchar_t>)
        return 'W';
    else if constexpr (std::is_same_v<T, long double>)
        return 'D';
    else if constexpr (std::is_floating_point_v<T>)
        return sizeof(T) == 4 ? 'f' : 'd';
    else if constexpr (sizeof(T) == 1)
        return 'c';
    else if constexpr (sizeof(T) == 2)
        return std::is_signed_v<T> ? 'n' : 'q';
    else if constexpr (sizeof(T) == 4)
        return std::is_signed_v<T> ? 'i' : 'u';
    else
        return std::is_signed_v<T> ? 'x' : 't';
}

} // namespace tandem::adaptor
