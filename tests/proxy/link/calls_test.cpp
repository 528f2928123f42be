// SPDX-License-Identifier: Apache-2.0
// How many calls a link carries at once, how long they may be, and what happens beyond these limits.
#include "link_side.hpp"

#include "proxy/link/protocol/call_limits.hpp"

#include <future>
#include <mutex>
#include <numeric>

using namespace tandem::link;
using namespace tandem::link::test;

namespace {

struct TwoSides {
    explicit TwoSides(const std::string& what) : name(unique_name(what)) {}
    void open() {
        a->link.open();
        b->link.open();
        wait_until_up(*a, *b);
    }
    const std::string name;
    std::unique_ptr<LinkSide> a = adaptor(name), b = interceptor(name);
};

/// A side that calls back until the operation, a number, is 0.
std::function<Reply(const Request&)> bounce(LinkSide& here) {
    return [&here](const Request& request) {
        const int depth = std::stoi(std::string(request.operation));
        if (depth == 0) return Reply{CallStatus::ok, bytes_of("bottom")};
        return here.link.call({"p", std::to_string(depth - 1), "", {}}, soon);
    };
}

/// Makes the side note the operations of its calls, and holds them until `release`.
struct Notes {
    explicit Notes(LinkSide& side) {
        side.on_call = [this](const Request& request) {
            eventually([&] { return release.load(); });
            const std::lock_guard lock(mutex);
            noted.push_back(std::stoi(std::string(request.operation)));
            return Reply{};
        };
    }
    bool are(int count) {
        std::vector<int> expected(static_cast<std::size_t>(count));
        std::iota(expected.begin(), expected.end(), 0);
        return eventually([&] {
            const std::lock_guard lock(mutex);
            return noted == expected;
        });
    }
    std::atomic<bool> release{false};
    std::mutex mutex;
    std::vector<int> noted;
};

} // namespace

TEST_CASE("calls go in both directions, even from within a call") {
    const auto name = unique_name("calls");
    auto a = adaptor(name), b = interceptor(name);
    b->on_call = [&](const Request& request) {
        return b->link.call({"p", "front", "", request.arguments}, soon);
    };
    a->on_call = [](const Request& request) { return Reply{CallStatus::ok, bytes_of(request.operation)}; };
    a->link.open();
    b->link.open();
    wait_until_up(*a, *b);
    const auto reply = a->link.call({"p", "back", ":", {}}, soon);
    CHECK(reply.status == CallStatus::ok);
    CHECK(reply.text() == "front");
}

TEST_CASE("two chains of 16 nested calls at once return") {
    TwoSides sides("nested");
    sides.a->on_call = bounce(*sides.a);
    sides.b->on_call = bounce(*sides.b);
    sides.open();
    const auto chain = [&] { return sides.a->link.call({"p", "16", "", {}}, soon).text(); };
    for (int round = 0; round < 5; ++round) {
        auto other = std::async(std::launch::async, chain);
        CHECK(chain() == "bottom");
        CHECK(other.get() == "bottom");
    }
}

TEST_CASE("a chain of nested calls may cross in each direction as often as there may be calls under way") {
    TwoSides sides("chain");
    sides.a->on_call = bounce(*sides.a);
    sides.b->on_call = bounce(*sides.b);
    sides.open();
    const auto longest = std::to_string(2 * max_calls - 1);
    CHECK(sides.a->link.call({"p", longest, "", {}}, soon).text() == "bottom");
}

TEST_CASE("64 callers of each side at once all get their results, even while each call is held") {
    TwoSides sides("callers");
    std::atomic<int> held{0};
    for (auto* side : {sides.a.get(), sides.b.get()})
        side->on_call = [&held](const Request& request) {
            ++held;
            eventually([&] { return held >= 128; });
            return Reply{CallStatus::ok, {request.arguments.begin(), request.arguments.end()}};
        };
    sides.open();
    std::vector<std::future<std::string>> callers;
    for (int i = 0; i < 128; ++i)
        callers.push_back(std::async(std::launch::async, [&, i] {
            auto& link = (i % 2 == 0 ? sides.a : sides.b)->link;
            return link.call({"p", "o", "", bytes_of(std::to_string(i))}, soon).text();
        }));
    for (int i = 0; i < 128; ++i) CHECK(callers[static_cast<std::size_t>(i)].get() == std::to_string(i));
    CHECK(held == 128);
}

TEST_CASE("callers beyond the calls that may be under way wait for one of them to end") {
    TwoSides sides("waiting");
    Notes notes(*sides.b);
    sides.open();
    std::vector<std::future<CallStatus>> callers;
    for (std::uint32_t i = 0; i < max_calls + 20; ++i)
        callers.push_back(std::async(std::launch::async, [&] {
            return sides.a->link.call({"p", "0", "", {}}, soon).status;
        }));
    CHECK(sides.a->link.call({"p", "0", "", {}}, 1ms).status != CallStatus::ok);
    notes.release = true;
    for (auto& caller : callers) CHECK(caller.get() == CallStatus::ok);
}

TEST_CASE("calls of up to 64 MiB cross both ways, and a longer one is refused before it runs") {
    TwoSides sides("long");
    sides.open();
    const std::vector<std::byte> sent(max_call_bytes - 1000, std::byte{42});
    for (auto* side : {sides.a.get(), sides.b.get()}) {
        const auto reply = side->link.call({"p", "o", "", sent}, soon);
        CHECK(reply.status == CallStatus::ok);
        CHECK(reply.bytes == sent);
    }
    const auto refused = sides.a->link.call({"p", "o", "", std::vector<std::byte>(max_call_bytes)}, soon);
    CHECK(refused.status == CallStatus::bad_arguments);
    CHECK(refused.text().find("the call queue takes 67108864") != std::string::npos);
}

TEST_CASE("calls without a reply do not wait for the peer and run in order, and those beyond 256 wait for a "
          "place") {
    TwoSides sides("send");
    CHECK(sides.a->link.send({"p", "o", "", {}}, soon).status == CallStatus::not_ready);
    Notes notes(*sides.b);
    sides.open();
    const auto send_one = [&](int number) {
        return sides.a->link.send({"p", std::to_string(number), "", bytes_of("x")}, soon).status;
    };
    const int at_once = max_waiting_sends, all = 3 * at_once;
    for (int i = 0; i < at_once; ++i) REQUIRE(send_one(i) == CallStatus::ok);
    CHECK(notes.noted.empty());
    auto rest = std::async(std::launch::async, [&] {
        for (int i = at_once; i < all; ++i)
            if (send_one(i) != CallStatus::ok) return false;
        return true;
    });
    notes.release = true;
    CHECK(rest.get());
    CHECK(notes.are(all));
}

TEST_CASE("a task that finds no place in its queue within its time is refused, and others keep their order") {
    TaskQueue queue("test", 1);
    std::atomic<bool> release{false};
    std::vector<int> ran; // [task thread]
    const auto task = [&](int number) {
        return [&, number] {
            eventually([&] { return release.load(); });
            ran.push_back(number);
        };
    };
    queue.post(task(0));
    CHECK_FALSE(queue.post_in_turn(5ms, 0, task(-1)));
    auto later = std::async(std::launch::async, [&] { return queue.post_in_turn(soon, 0, task(1)); });
    queue.start();
    release = true;
    CHECK(later.get());
    CHECK(queue.post_in_turn(soon, 0, task(2)));
    std::promise<void> last;
    queue.post([&] { last.set_value(); });
    last.get_future().wait();
    CHECK(ran == std::vector{0, 1, 2});
    queue.stop();
    CHECK(queue.post_in_turn(soon, 0, task(3)));
    CHECK_FALSE(queue.post_in_turn(soon, 0, task(4)));
}

TEST_CASE("tasks that wait hold bounded memory, but a longer one finds a place in an empty queue") {
    TaskQueue queue("test", 10, 100);
    const auto post = [&](std::size_t bytes) { return queue.post_in_turn(5ms, bytes, [] {}); };
    CHECK(post(1000));
    CHECK_FALSE(post(1));
    queue.start();
    CHECK(queue.post_in_turn(soon, 60, [] {}));
    queue.stop();
    TaskQueue other("test", 10, 100);
    CHECK(other.post_in_turn(5ms, 60, [] {}));
    CHECK_FALSE(other.post_in_turn(5ms, 41, [] {}));
    CHECK(other.post_in_turn(5ms, 40, [] {}));
}
