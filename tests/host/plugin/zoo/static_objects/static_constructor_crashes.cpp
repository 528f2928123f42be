// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
namespace {
int* volatile nowhere = nullptr;
struct Writer {
    Writer() { *nowhere = 1; }
} writer;
} // namespace
ZOO_ENTRY { return ZOO_RESULT; }
