// SPDX-License-Identifier: Apache-2.0
// Nothing is wrong with it, except for a library that it needs.
#include "tests/host/plugin/zoo/entry.hpp"

extern "C" int in_old_helper();
extern "C" int uses_it() { return in_old_helper(); }

ZOO_ENTRY { return ZOO_RESULT; }
