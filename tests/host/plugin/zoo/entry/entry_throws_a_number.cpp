// SPDX-License-Identifier: Apache-2.0
#include "tests/host/plugin/zoo/entry.hpp"
ZOO_ENTRY { throw 42; }
