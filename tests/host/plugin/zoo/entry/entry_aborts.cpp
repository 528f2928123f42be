// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#undef NDEBUG
#include <cassert>
ZOO_ENTRY {
    const bool calibrated = false;
    assert(calibrated);
    return ZOO_RESULT;
}
