// SPDX-License-Identifier: Apache-2.0
// The threads that execute the peer's calls.
#include "proxy/link/protocol/call_limits.hpp"
#include "tests/proxy/link/link_side.hpp"

#include <atomic>
#include <fstream>
#include <future>
#include <pthread.h>
#include <vector>

using namespace tandem::link;
using namespace tandem::link::test;

namespace {

constexpr int callers = 20;

/// The workers of both sides.
int count_workers() {
    int count = 0;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
        std::string name;
        std::getline(std::ifstream(thread.path() / "comm"), name);
        count += name == "tandem-worker" ? 1 : 0;
    }
    return count;
}

struct Sides {
    explicit Sides(const std::string& what, std::chrono::nanoseconds idle_time = worker_idle_time) {
        LinkOptions options{unique_name(what)};
        options.worker_idle_time = idle_time;
        first = std::make_unique<LinkSide>(tandem::shm::Side::first, options, PortTable{});
        second = std::make_unique<LinkSide>(tandem::shm::Side::second, options, joystick_table());
        first->link.open();
        second->link.open();
        wait_until_up(*first, *second);
    }
    /// Has many calls under way at once, until there is another worker. Returns how many succeeded.
    int call_at_once() {
        std::atomic<int> held{0};
        std::atomic<bool> counted{false};
        second->on_call = [&](const Request&) {
            ++held;
            eventually([&] { return counted.load(); });
            return Reply{};
        };
        std::vector<std::future<CallStatus>> calls;
        for (int i = 0; i < callers; ++i)
            calls.push_back(std::async(std::launch::async, [&] {
                return first->link.call({"p", "o", "", {}}, soon).status;
            }));
        CHECK(eventually([&] { return held == callers && count_workers() > callers; }));
        counted = true;
        int succeeded = 0;
        for (auto& call : calls) succeeded += call.get() == CallStatus::ok ? 1 : 0;
        second->on_call = [](const Request&) { return Reply{}; };
        return succeeded;
    }

    std::unique_ptr<LinkSide> first, second;
};

} // namespace

TEST_CASE("workers that have not been needed for a long time end, even while calls continue, and come back "
          "when needed") {
    const bool calls_go_on = GENERATE(false, true);
    Sides sides("surplus", 100ms);
    CHECK(sides.call_at_once() == callers);
    CHECK(eventually([&] {
        if (calls_go_on) sides.first->link.call({"p", "o", "", {}}, soon);
        return count_workers() <= 3; // one of the callers' side
    }));
    CHECK(sides.call_at_once() == callers);
}

TEST_CASE("the stack of a worker is small, because locked memory includes all of it") {
    Sides sides("stack");
    std::size_t bytes = 0;
    sides.second->on_call = [&bytes](const Request&) {
        pthread_attr_t attributes;
        pthread_getattr_np(pthread_self(), &attributes);
        pthread_attr_getstacksize(&attributes, &bytes);
        pthread_attr_destroy(&attributes);
        return Reply{};
    };
    CHECK(sides.first->link.call({"p", "o", "", {}}, soon).status == CallStatus::ok);
    CHECK(bytes == worker_stack_bytes);
}
