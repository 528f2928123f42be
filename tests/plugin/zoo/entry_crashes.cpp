// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
namespace {
int* volatile nowhere = nullptr;
}
ZOO_ENTRY {
    *nowhere = 1;
    return ZOO_RESULT;
}
