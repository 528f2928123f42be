// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#include <cstdio>
#include <cstdlib>
ZOO_ENTRY {
    std::fputs("usage: component DEVICE\n", stderr);
    std::exit(3);
}
