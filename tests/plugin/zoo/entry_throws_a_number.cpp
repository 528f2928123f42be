// SPDX-License-Identifier: Apache-2.0
#include "entry.hpp"
ZOO_ENTRY { throw 42; }
