// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#include <unistd.h>
namespace {
struct Waiter {
    Waiter() {
        for (;;) pause();
    }
} waiter;
} // namespace
ZOO_ENTRY { return ZOO_RESULT; }
