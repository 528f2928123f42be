// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#include <cstdio>
#include <cstdlib>
namespace {
struct Licence {
    Licence() {
        std::fputs("no licence\nfor this robot\n", stderr);
        std::abort();
    }
} licence;
} // namespace
ZOO_ENTRY { return ZOO_RESULT; }
