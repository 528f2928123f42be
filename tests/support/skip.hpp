// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <catch2/catch.hpp>
#include <string>

namespace tandem::test {

/// Why the TEST_CASE that runs, or a part of it, cannot run here; empty if it can.
inline std::string skipped_because;

} // namespace tandem::test

/// Says that a part of the TEST_CASE cannot run here. If nothing else in it fails, ctest counts it as skipped and names it.
#define TANDEM_SKIP_PART(reason) ((void)(tandem::test::skipped_because = (reason)))

/// Ends the TEST_CASE, which cannot run here.
#define TANDEM_SKIP(reason)                                                                                  \
    do {                                                                                                     \
        TANDEM_SKIP_PART(reason);                                                                            \
        SUCCEED(tandem::test::skipped_because);                                                              \
        return;                                                                                              \
    } while (false)
