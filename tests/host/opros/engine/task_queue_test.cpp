// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/task_queue.hpp"
#include "tests/host/opros/engine/running.hpp"

#include <algorithm>
#include <latch>

using tandem::engine::TaskQueue;

namespace {

/// Keeps a queue busy until it is released.
struct BlockingTask {
    std::latch begun{1}, release{1};
    void submit_to(TaskQueue& queue) {
        queue.start();
        REQUIRE(queue.submit([this] {
            begun.count_down();
            release.wait();
        }));
        begun.wait();
    }
};

} // namespace

TEST_CASE("tasks of one queue run in order and never two at a time") {
    std::vector<int> done; // no lock: the thread sanitizer would report two tasks at a time
    std::atomic<int> count{0};
    TaskQueue queue(1000, TaskQueue::Mode::own_thread);
    queue.start();
    for (int i = 0; i < 200; ++i)
        REQUIRE(queue.submit([&, i] {
            done.push_back(i);
            ++count;
        }));
    REQUIRE(eventually([&] { return count == 200; }));
    CHECK(std::is_sorted(done.begin(), done.end()));
}

TEST_CASE("slow tasks of twenty queues do not delay another queue") {
    std::atomic<bool> done{false};
    BlockingTask slow[20];
    std::deque<TaskQueue> queues;
    for (BlockingTask& each : slow) each.submit_to(queues.emplace_back(10, TaskQueue::Mode::own_thread));
    TaskQueue other(10, TaskQueue::Mode::own_thread);
    other.start();
    CHECK(other.submit([&] { done = true; }));
    CHECK(eventually([&] { return done.load(); }));
    for (BlockingTask& each : slow) each.release.count_down();
}

TEST_CASE("a full queue refuses further tasks") {
    BlockingTask slow;
    TaskQueue queue(2, TaskQueue::Mode::own_thread);
    slow.submit_to(queue);
    CHECK(queue.submit([] {}));
    CHECK(queue.submit([] {}));
    CHECK_FALSE(queue.submit([] {}));
    slow.release.count_down();
}

TEST_CASE("a queue in mode in_caller runs a task within submit") {
    TaskQueue queue(1, TaskQueue::Mode::in_caller);
    bool done = false;
    CHECK(queue.submit([&] { done = true; }));
    CHECK(done);
}

TEST_CASE("an interrupted queue refuses tasks") {
    for (const auto mode : {TaskQueue::Mode::own_thread, TaskQueue::Mode::in_caller}) {
        TaskQueue queue(1, mode);
        queue.start();
        queue.interrupt();
        queue.join();
        CHECK_FALSE(queue.submit([] {}));
    }
}
