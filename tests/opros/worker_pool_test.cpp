// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/worker_pool.hpp"
#include "tests/opros/running.hpp"

#include <algorithm>
#include <latch>

using tandem::engine::WorkerPool;

TEST_CASE("jobs of one lane are done in order and never two at a time") {
    WorkerPool pool(3, 1000);
    std::vector<int> done;
    std::atomic<int> count{0};
    for (int i = 0; i < 200; ++i)
        REQUIRE(pool.submit(1, [&, i] {
            done.push_back(i);
            ++count;
        }));
    REQUIRE(eventually([&] { return count == 200; }));
    CHECK(std::is_sorted(done.begin(), done.end()));
}

TEST_CASE("a pool whose worker has its hands full takes no more jobs") {
    WorkerPool pool(1, 2);
    std::latch begun(1), go(1);
    REQUIRE(pool.submit(0, [&] {
        begun.count_down();
        go.wait();
    }));
    begun.wait();
    CHECK(pool.submit(0, [] {}));
    CHECK(pool.submit(0, [] {}));
    CHECK_FALSE(pool.submit(0, [] {}));
    go.count_down();
}

TEST_CASE("a pool without workers does jobs at once") {
    WorkerPool pool(0, 1);
    bool done = false;
    CHECK(pool.submit(7, [&] { done = true; }));
    CHECK(done);
}

TEST_CASE("a stopped pool takes no jobs") {
    WorkerPool pool(1, 1);
    pool.stop();
    CHECK_FALSE(pool.submit(0, [] {}));
}
