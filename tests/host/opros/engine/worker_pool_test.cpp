// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/worker_pool.hpp"
#include "tests/host/opros/engine/running.hpp"

#include <algorithm>
#include <latch>

using tandem::engine::Worker;
using tandem::engine::WorkerPool;

namespace {
/// Its worker is busy until it is let go.
struct Receiver {
    std::latch begun{1}, go{1};
    void take(Worker& worker) {
        REQUIRE(worker.submit([this] {
            begun.count_down();
            go.wait();
        }));
        begun.wait();
    }
};
} // namespace

TEST_CASE("jobs of one receiver are done in order and never two at a time") {
    WorkerPool pool(1000, true);
    const int receiver = 0;
    std::vector<int> done; // no lock: the thread sanitizer would tell of two at a time
    std::atomic<int> count{0};
    for (int i = 0; i < 200; ++i)
        REQUIRE(pool.of(&receiver).submit([&, i] {
            done.push_back(i);
            ++count;
        }));
    REQUIRE(eventually([&] { return count == 200; }));
    CHECK(std::is_sorted(done.begin(), done.end()));
}

TEST_CASE("slow receivers delay nobody else however many they are") {
    WorkerPool pool(10, true);
    Receiver slow[20];
    for (Receiver& each : slow) each.take(pool.of(&each));
    std::atomic<bool> done{false};
    const int other = 0;
    CHECK(pool.of(&other).submit([&] { done = true; }));
    CHECK(eventually([&] { return done.load(); }));
    for (Receiver& each : slow) each.go.count_down();
}

TEST_CASE("a worker that has its hands full takes no more jobs") {
    WorkerPool pool(2, true);
    Receiver slow;
    Worker& worker = pool.of(&slow);
    slow.take(worker);
    CHECK(worker.submit([] {}));
    CHECK(worker.submit([] {}));
    CHECK_FALSE(worker.submit([] {}));
    slow.go.count_down();
}

TEST_CASE("a worker without a thread does jobs at once") {
    Worker worker(1, false);
    bool done = false;
    CHECK(worker.submit([&] { done = true; }));
    CHECK(done);
}

TEST_CASE("workers of a stopped pool take no jobs") {
    for (const bool with_threads : {true, false}) {
        WorkerPool pool(1, with_threads);
        Worker& worker = pool.of(nullptr);
        pool.stop();
        CHECK_FALSE(worker.submit([] {}));
    }
}
