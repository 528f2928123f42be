// SPDX-License-Identifier: Apache-2.0
// A link in a process that may start no more threads.
#include "tests/proxy/link/link_side.hpp"
#include "tests/support/thread_limit.hpp"

using namespace tandem::link;
using namespace tandem::link::test;

TEST_CASE("a link that gets no more workers serves calls with the one that it has") {
    const bool holds = tandem::test::holds_at_thread_limit([](const auto& reach_limit) {
        const auto name = unique_name("limit");
        auto first = adaptor(name);
        auto second = interceptor(name);
        first->link.open();
        second->link.open();
        wait_until_up(*first, *second);
        reach_limit();
        for (int i = 0; i < 3; ++i)
            if (first->link.call({"port", "operation", "", bytes_of("value")}, soon).bytes !=
                bytes_of("value"))
                return false;
        return true;
    });
    CHECK(holds);
}
