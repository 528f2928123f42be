// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
extern int nobody_defines_this();
ZOO_ENTRY {
    nobody_defines_this();
    return ZOO_RESULT;
}
