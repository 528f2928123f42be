// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
#undef NDEBUG
#include <cassert>
ZOO_ENTRY {
    const bool calibrated = false;
    assert(calibrated);
    return ZOO_RESULT;
}
