// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
#include <stdexcept>
ZOO_ENTRY { throw std::runtime_error("no camera\nat port 3"); }
