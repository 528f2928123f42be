// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_client.hpp"
#include "shm/call/call_server.hpp"
#include "shm/inspect/call_follower.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "tests/shm/fixture.hpp"

#include <atomic>
#include <cstring>
#include <thread>

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

std::vector<std::byte> bytes_of(std::uint64_t number, std::size_t length) {
    std::vector<std::byte> bytes(length, std::byte{static_cast<unsigned char>(number)});
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

std::uint64_t number_of(std::span<const std::byte> bytes) {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

/// A queue whose worker answers each call with ten times its number, in as many bytes as it was told.
class FollowedQueue {
  public:
    explicit FollowedQueue(bool keep_history = true, std::size_t result_bytes = 8)
        : result_bytes_(result_bytes), callers_(join(link_, Side::first)), server_(join(link_, Side::second)),
          queue_(server_->add_call_queue(
              "calls", {.callers = Side::first, .slots = 4, .max_bytes = std::size_t{1} << 18})) {
        server_->publish();
        client_.emplace(*callers_->find_call_queue(Side::second, "calls"),
                        WaitOptions{.keep_history = keep_history});
        worker_ = std::thread([this] { work(); });
        const auto observation = observe(link_.name);
        REQUIRE(observation);
        REQUIRE(observation->call_queues.size() == 1);
        follower_.emplace(std::make_shared<const ReadOnlySnapshot>(observation->segment.path),
                          observation->call_queues[0]);
    }
    ~FollowedQueue() {
        ended_ = true;
        queue_.shut_down();
        worker_.join();
    }

    void call(std::uint64_t number, std::size_t bytes = 8) {
        REQUIRE(client_->call(bytes_of(number, bytes), std::chrono::seconds(60)).status == CallStatus::ok);
    }
    /// The numbers of the calls, and of the results behind them.
    std::vector<std::uint64_t> poll(CallActivity activity) {
        std::vector<std::uint64_t> numbers;
        follower_->poll(
            [&](const FollowedCall& call) {
                CHECK(call.answered);
                CHECK(call.status == CallStatus::ok);
                CHECK(std::equal(call.arguments.begin() + 8, call.arguments.end(),
                                 bytes_of(number_of(call.arguments), call.arguments.size()).begin() + 8));
                CHECK(call.results.size() == result_bytes_);
                CHECK(number_of(call.results) == 10 * number_of(call.arguments));
                numbers.push_back(number_of(call.arguments));
            },
            activity);
        return numbers;
    }
    const CallFollower& follower() const { return *follower_; }

  private:
    void work() {
        while (!ended_)
            if (auto call = queue_.take(std::chrono::milliseconds(100)))
                call->reply(CallStatus::ok, bytes_of(10 * number_of(call->arguments()), result_bytes_));
    }

    const std::size_t result_bytes_;
    Link link_;
    std::unique_ptr<Segment> callers_, server_;
    CallServer queue_;
    std::optional<CallClient> client_;
    std::optional<CallFollower> follower_;
    std::atomic<bool> ended_{false};
    std::thread worker_;
};

using Numbers = std::vector<std::uint64_t>;

} // namespace

TEST_CASE("Calls are copied with their replies, in order, once a second look has confirmed them") {
    FollowedQueue queue;
    CHECK(queue.poll(CallActivity::possible).empty());
    for (const std::uint64_t number : {1, 2, 3}) queue.call(number);
    CHECK(queue.poll(CallActivity::possible).empty());
    CHECK(queue.poll(CallActivity::possible) == Numbers{1, 2, 3});
    CHECK(queue.poll(CallActivity::possible).empty());
    queue.call(4);
    CHECK(queue.poll(CallActivity::none) == Numbers{4});
    CHECK(queue.follower().lost() == 0);
}

TEST_CASE("The history contains the calls of all threads") {
    FollowedQueue queue;
    for (const std::uint64_t number : {1, 2, 3}) std::thread([&] { queue.call(number); }).join();
    CHECK(queue.poll(CallActivity::none) == Numbers{1, 2, 3});
}

TEST_CASE("Calls whose slot was used again are counted as lost") {
    FollowedQueue queue;
    CHECK(queue.poll(CallActivity::none).empty());
    for (std::uint64_t number = 1; number <= 10; ++number) queue.call(number);
    CHECK(queue.poll(CallActivity::none) == Numbers{7, 8, 9, 10});
    CHECK(queue.follower().lost() == 6);
    CHECK(queue.follower().delivered() == 4);
}

TEST_CASE("Without a history a thread's last call is found") {
    FollowedQueue queue(false);
    CHECK(queue.poll(CallActivity::none).empty());
    for (std::uint64_t number = 1; number <= 10; ++number) queue.call(number);
    CHECK(queue.poll(CallActivity::none) == Numbers{10});
    CHECK(queue.follower().lost() == 9);
}

TEST_CASE("Calls before the first reading do not count as lost, and the last of them are found") {
    FollowedQueue queue;
    for (std::uint64_t number = 1; number <= 6; ++number) queue.call(number);
    CHECK(queue.poll(CallActivity::none) == Numbers{3, 4, 5, 6});
    CHECK(queue.follower().lost() == 0);
}

TEST_CASE("Long arguments are copied from the file after the slots, unless long results have replaced them") {
    FollowedQueue queue;
    queue.call(1, 5000);
    CHECK(queue.poll(CallActivity::none) == Numbers{1});
    FollowedQueue both(true, 6000);
    both.poll(CallActivity::none);
    both.call(2, 5000);
    CHECK(both.poll(CallActivity::none).empty());
    CHECK(both.follower().lost() == 1);
    both.call(3, 40);
    CHECK(both.poll(CallActivity::none) == Numbers{3});
}

TEST_CASE("A call by loan counts as lost, and the calls around it are copied") {
    FollowedQueue queue;
    CHECK(queue.poll(CallActivity::possible).empty());
    queue.call(1);
    queue.call(2, 100'000);
    queue.call(3);
    CHECK(queue.poll(CallActivity::none) == Numbers{1, 3});
    CHECK(queue.follower().lost() == 1);
    CHECK_FALSE(queue.follower().damaged());
}
