// SPDX-License-Identifier: Apache-2.0
// Tells ctest of a TEST_CASE that could not run: the line is the SKIP_REGULAR_EXPRESSION of tandem_add_test, which would hide a
// failure, too.
#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "tests/support/skip.hpp"

#include <iostream>

namespace {

using Listener = Catch::TestEventListenerBase; // with Catch2 3, the name is an alias

class SkipListener : public Listener {
  public:
    using Listener::Listener;

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        std::string& reason = tandem::test::skipped_because;
        if (!reason.empty() && stats.totals.assertions.allOk())
            std::cout << "tandem-test-skipped: " << reason << std::endl;
        reason.clear();
        Listener::testCaseEnded(stats);
    }
};

CATCH_REGISTER_LISTENER(SkipListener)

} // namespace
