// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
extern "C" int in_another_library();
ZOO_ENTRY {
    in_another_library();
    return ZOO_RESULT;
}
