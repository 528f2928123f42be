// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#include <stdexcept>
namespace {
int open_device() { throw std::runtime_error("no device"); }
const int device = open_device();
} // namespace
ZOO_ENTRY {
    static_cast<void>(device);
    return ZOO_RESULT;
}
