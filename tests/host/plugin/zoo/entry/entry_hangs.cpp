// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
namespace {
volatile bool forever = true;
}
ZOO_ENTRY {
    while (forever) continue;
    return ZOO_RESULT;
}
