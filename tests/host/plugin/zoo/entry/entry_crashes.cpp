// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
namespace {
int* volatile nowhere = nullptr;
}
ZOO_ENTRY {
    *nowhere = 1;
    return ZOO_RESULT;
}
