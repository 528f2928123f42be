// SPDX-License-Identifier: Apache-2.0
// Arguments and results that are too long for a slot and its buffer.
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

namespace {

constexpr std::size_t longest = layout::max_loan_bytes, shortest = layout::short_call_bytes + 1;

std::vector<std::byte> pattern(std::size_t bytes) {
    std::vector<std::byte> made(bytes);
    for (std::size_t i = 0; i < bytes; ++i) made[i] = static_cast<std::byte>(i * 2654435761U >> 13U);
    return made;
}

struct LongCalls : CallPair {
    explicit LongCalls(std::uint32_t slots = 2) : CallPair({.slots = slots, .max_bytes = longest}) {}
    std::uint64_t memory_in_file() const { return seen->mapping->memory_bytes(); }
    std::optional<CallQueueHandle> seen = first->find_call_queue(Side::first, "c");
};

/// Has memory for short results only.
struct LittleMemory final : ResultMemory {
    std::span<std::byte> room_for(std::size_t bytes) override {
        if (bytes > 1000) throw std::bad_alloc();
        room.resize(bytes);
        return room;
    }
    std::vector<std::byte> room;
};

} // namespace

TEST_CASE("arguments and results of up to 64 MiB cross unchanged and leave no memory behind") {
    LongCalls calls;
    const std::uint64_t before = calls.memory_in_file();
    Workers workers(calls.server, 1, echo);
    for (const std::size_t bytes : {shortest - 2, shortest - 1, shortest, std::size_t{1'000'003}, longest}) {
        const auto sent = pattern(bytes);
        const Reply reply = calls.client.call(sent, 60s);
        CHECK(reply.status == CallStatus::ok);
        CHECK(reply.bytes == sent);
    }
    CHECK(calls.memory_in_file() == before);
}

TEST_CASE("long results of a short call cross, and so do long arguments with a short result") {
    LongCalls calls;
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        if (call.arguments().size() > 1000)
            call.reply(CallStatus::ok, std::to_string(call.arguments().size()));
        else
            call.reply(CallStatus::ok, pattern(number_of(call)));
    });
    for (int round = 0; round < 3; ++round) {
        CHECK(calls.client.call(bytes_of("3000000"), 60s).bytes == pattern(3'000'000));
        CHECK(calls.client.call(pattern(2'000'000), 60s).text() == "2000000");
        CHECK(calls.client.call(bytes_of("10"), 60s).bytes == pattern(10));
    }
}

TEST_CASE("long calls of many callers at once keep their bytes apart") {
    LongCalls calls(4);
    Workers workers(calls.server, 4, echo);
    std::atomic<int> wrong{0};
    std::vector<std::thread> callers;
    for (std::size_t i = 0; i < 16; ++i)
        callers.emplace_back([&, i] {
            const auto sent = pattern(shortest + i * 50'000);
            for (std::size_t round = 0; round < 20; ++round)
                wrong += calls.client.call(sent, 60s).bytes != sent;
        });
    for (auto& caller : callers) caller.join();
    CHECK(wrong == 0);
}

TEST_CASE("more than 64 MiB are refused with both numbers, arguments before the call runs") {
    LongCalls calls(1);
    const std::vector<std::byte> too_long(longest + 1);
    const Reply refused = calls.client.call(too_long, 60s);
    CHECK(refused.status == CallStatus::bad_arguments);
    CHECK(refused.text() == "arguments of 67108865 bytes, the call queue takes 67108864");
    CHECK(calls.client.counters().calls == 0);
    Workers workers(calls.server, 1, [&](IncomingCall& call) { call.reply(CallStatus::ok, too_long); });
    const Reply failed = calls.client.call({}, 60s);
    CHECK(failed.status == CallStatus::exception);
    CHECK(failed.text() == "a result of 67108865 bytes, the call queue takes 67108864");
    CHECK_THROWS_AS(calls.first->add_call_queue("d", {.max_bytes = longest + 1}), Error);
    CHECK_THROWS_AS(calls.first->add_call_queue("e", {.max_bytes = longest}), Error);
}

TEST_CASE("a caller without memory for long results gets this error, and its slot becomes free") {
    LongCalls calls(1);
    const std::uint64_t before = calls.memory_in_file();
    Workers workers(calls.server, 1, [](IncomingCall& call) {
        call.reply(CallStatus::ok, pattern(call.arguments().empty() ? shortest : 1));
    });
    LittleMemory memory;
    const ReplyView failed = calls.client.call_into({}, 60s, memory);
    CHECK(failed.status == CallStatus::exception);
    CHECK(text_of(failed.bytes) == "results of 65537 bytes do not fit into the free memory of this process");
    CHECK(calls.memory_in_file() == before);
    CHECK(calls.client.call_into(bytes_of("x"), 60s, memory).status == CallStatus::ok);
}

TEST_CASE("a long call that its caller gives up leaves no memory behind, whether it runs or not") {
    LongCalls calls(1);
    const std::uint64_t before = calls.memory_in_file();
    const auto sent = pattern(1'000'000);
    CHECK(calls.client.call(sent, 5ms).status == CallStatus::timeout); // no worker
    CHECK(calls.memory_in_file() == before);
    auto late = std::async(std::launch::async, [&] { return calls.client.call(sent, 50ms).status; });
    auto running = calls.server.take(10s);
    CHECK(late.get() == CallStatus::timeout);
    if (running) running->reply(CallStatus::ok, sent);
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(bytes_of("x"), 60s).text() == "x");
    CHECK(calls.memory_in_file() == before);
}

TEST_CASE("a peer that claims a loan and has not written it is refused") {
    LongCalls calls(1);
    auto& slot = calls.seen->view.slots[0];
    const auto taken = [&](std::uint64_t length) {
        slot.request.deadline_ns.store(~std::uint64_t{0});
        slot.request.word.store(call_word(layout::CallState::submitted, 7 + length, length));
        return calls.server.take(0ns).has_value();
    };
    for (const std::uint64_t length :
         {std::uint64_t{shortest}, std::uint64_t{longest}, std::uint64_t{0xffffffff}}) {
        CHECK_FALSE(taken(length));
        CHECK(static_cast<CallStatus>(tag_of(slot.reply.word.load())) == CallStatus::bad_arguments);
    }
    SECTION("in a file that it has made longer") {
        const std::string path = calls.first->path();
        REQUIRE(truncate(path.c_str(), off_t{4} * longest + off_t{1} * 1024 * 1024 * 1024) == 0);
        CHECK_FALSE(taken(longest - 1));
    }
    slot.request.word.store(0);
    auto caller = std::async(std::launch::async, [&] { return calls.client.call({}, 60s); });
    while (caller.wait_for(1ms) != std::future_status::ready)
        slot.reply.word.store(call_word(CallStatus::ok, sequence_of(slot.request.word.load()), longest));
    const Reply reply = caller.get();
    CHECK(reply.status == CallStatus::exception);
    CHECK(reply.text() == "the peer has damaged the reply");
}

TEST_CASE("a side that dies during a long call takes its loan with it") {
    Link link;
    auto first = join(link, Side::first);
    CallClient client(first->add_call_queue("c", {.slots = 2, .max_bytes = longest}));
    first->publish();
    Child server([&] {
        auto second = join(link, Side::second);
        CallServer queue(*second->find_call_queue(Side::first, "c"));
        auto call = queue.take(20s);
        return call && call->arguments().size() == longest ? (raise(SIGKILL), 1) : 2;
    });
    CHECK(client.call(pattern(longest), 60s).status == CallStatus::peer_died);
    server.wait();
    CHECK(first->find_call_queue(Side::first, "c")->mapping->memory_bytes() < longest);
    first->leave();
    CHECK(link.files().empty());
}
