// SPDX-License-Identifier: Apache-2.0
// One object file that was built against the headers of another Tandem, among object files that were built against ours.
#include "another_number.hpp"

#ifdef ZOO_INIT
#include <rtm/TandemAbi.h>
#else
#include <TandemAbi.h>
#endif

#include "tests/host/plugin/zoo/entry.hpp"

ZOO_ENTRY { return ZOO_RESULT; }
