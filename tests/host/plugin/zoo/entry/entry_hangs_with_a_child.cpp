// SPDX-License-Identifier: Apache-2.0
// The child inherits all descriptors and outlives its parent.
#include "tests/host/plugin/zoo/entry.hpp"
#include <unistd.h>
ZOO_ENTRY {
    fork();
    for (;;) pause();
}
