// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
namespace {
volatile int depth_of_the_tree = 2000000000; // the compiler must not see that there is no end
int deeper(int depth) {
    volatile int frame[1000] = {depth};
    return depth < depth_of_the_tree ? deeper(depth + 1) + frame[0] : 0;
}
} // namespace
ZOO_ENTRY {
    deeper(0);
    return ZOO_RESULT;
}
