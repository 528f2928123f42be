// SPDX-License-Identifier: Apache-2.0
// Built against the headers of another Tandem. Reports if any of its code runs.
#include "another_number.hpp"
#include "tests/host/plugin/zoo/entry.hpp"

#include <cstdio>
#include <cstdlib>

namespace {
struct Tells {
    Tells() {
        std::fputs("code of another Tandem has run\n", stderr);
        std::_Exit(7);
    }
} tells;
} // namespace

ZOO_ENTRY { return ZOO_RESULT; }
