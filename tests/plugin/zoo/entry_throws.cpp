// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
#include <stdexcept>
ZOO_ENTRY { throw std::runtime_error("no camera\nat port 3"); }
