// SPDX-License-Identifier: Apache-2.0
#include "another_number.hpp"

extern "C" int in_old_helper() { return 1; }
