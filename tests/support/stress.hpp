// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstdlib>

namespace tandem::test {

/// The size of a test: `usual`, times TANDEM_STRESS where that is set, and at most `largest`.
template <class Number>
Number stress(Number usual) {
    const char* factor = std::getenv("TANDEM_STRESS");
    return usual * static_cast<Number>(factor != nullptr ? std::max(1, std::atoi(factor)) : 1);
}
template <class Number>
Number stress(Number usual, Number largest) {
    return std::min(stress(usual), largest);
}

} // namespace tandem::test
