// SPDX-License-Identifier: Apache-2.0
// One end of a call queue is honest, the other writes what it likes into the words of the slots.
#include "call_fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;
using layout::CallState;

namespace {

constexpr std::uint64_t sequences[] = {0, 1, 2, call_sequence_mask};
constexpr std::uint64_t lengths[] = {0, 1, 63, 64, 65, 88, 113, 4096, 0x7fffffff, 0xffffffff};

/// All values that a word can have, in steps.
void for_each_word(const std::function<void(std::uint64_t)>& attempt) {
    for (std::uint32_t tag = 0; tag < 16; ++tag)
        for (const auto sequence : sequences)
            for (const auto length : lengths) attempt(call_word(tag, sequence, length));
}

} // namespace

TEST_CASE("a forged request is refused or runs within bounds") {
    CallPair calls({.slots = 2, .max_bytes = 64});
    auto& request = calls.second->find_call_queue(Side::first, "c")->view.slots[0].request;
    for_each_word([&](std::uint64_t word) {
        request.deadline_ns.store(~std::uint64_t{0});
        request.word.store(word);
        if (auto call = calls.server.take(0ns)) {
            CHECK(call->arguments().size() <= 64);
            CHECK(has_state(word, CallState::submitted));
            request.word.store(~word); // while it runs
            call->reply(CallStatus::ok, call->arguments());
        }
    });
}

TEST_CASE("the same call submitted again while it runs waits until the worker is out of the slot") {
    CallPair calls({.slots = 2, .max_bytes = 64});
    auto& request = calls.second->find_call_queue(Side::first, "c")->view.slots[0].request;
    request.deadline_ns.store(~std::uint64_t{0});
    request.word.store(call_word(CallState::submitted, 1, 8));
    auto running = calls.server.take(0ns);
    REQUIRE(running);
    for (std::uint64_t sequence = 1; sequence < 4; ++sequence) {
        request.word.store(call_word(CallState::submitted, sequence, 8));
        CHECK_FALSE(calls.server.take(0ns)); // two workers would share one private copy
    }
    running->reply(CallStatus::ok);
    CHECK(calls.server.take(0ns));
}

namespace {

/// Calls, and lets `forge` write to the slot while the caller waits.
Reply call_and_forge(CallClient& client, layout::CallSlot& slot, std::chrono::nanoseconds timeout,
                     const std::function<void()>& forge) {
    const std::uint64_t before = slot.request.word.load();
    auto reply = std::async(std::launch::async, [&] { return client.call(bytes_of("abc"), timeout); });
    eventually([&] { return slot.request.word.load() != before; });
    forge();
    return reply.get();
}

} // namespace

TEST_CASE("a forged reply becomes an error or a result within bounds") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto& slot = calls.first->find_call_queue(Side::first, "c")->view.slots[0];
    std::size_t accepted = 0, damaged = 0;
    for_each_word([&](std::uint64_t word) {
        if (sequence_of(word) != 1) return; // the sequence is replaced below
        const Reply reply = call_and_forge(calls.client, slot, 300s, [&] {
            const std::uint64_t sequence = sequence_of(slot.request.word.load());
            slot.reply.word.store(call_word(tag_of(word), sequence, length_of(word)));
        });
        CHECK(reply.bytes.size() <= 64);
        ++(reply.text() == "the peer has damaged the reply" ? damaged : accepted);
    });
    CHECK(accepted == 10 * 4); // ten statuses, lengths up to 64
    CHECK(damaged == 16 * std::size(lengths) - accepted);
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(bytes_of("sound again"), 20s).text() == "sound again");
}

TEST_CASE("a request word changed under a waiting caller ends its call and not its queue") {
    CallPair calls({.slots = 1, .max_bytes = 64});
    auto& slot = calls.first->find_call_queue(Side::first, "c")->view.slots[0];
    for_each_word([&](std::uint64_t word) {
        if (sequence_of(word) != 2) return; // of an older call, but for one
        const std::uint64_t planted = slot.reply.word.load();
        std::uint64_t own = 0;
        const Reply reply = call_and_forge(calls.client, slot, 2ms, [&] {
            own = slot.request.word.load();
            slot.request.word.store(word);
        });
        // A reply that the previous round has left may have this call's sequence, and is then valid.
        const bool replied = reply.status == CallStatus::ok && sequence_of(own) == sequence_of(planted);
        CHECK((replied || reply.status == CallStatus::exception || reply.status == CallStatus::timeout ||
               reply.status == CallStatus::overload));
        slot.reply.word.store(call_word(0, sequence_of(slot.request.word.load()), 0));
    });
    // Checks that no slot is left in use. A slot whose word names a worker would stay in use until that worker's reply.
    slot.reply.word.store(call_word(0, sequence_of(slot.request.word.load()), 0));
    Workers workers(calls.server, 1, echo);
    CHECK(calls.client.call(bytes_of("sound again"), 20s).text() == "sound again");
}

TEST_CASE("a caller gives up at its deadline whatever the words of the queue are") {
    CallPair calls({.slots = 2, .max_bytes = 64}, {.spin = 1us});
    auto& header = *calls.first->find_call_queue(Side::first, "c")->view.header;
    for (const std::uint32_t value : {0U, 1U, 2U, 3U, 0xffffffffU}) {
        for (auto* word : {&header.workers_asleep, &header.polling, &header.wake_count}) {
            const std::uint32_t before = word->exchange(value);
            CHECK(calls.client.call({}, 1ms).status == CallStatus::timeout);
            word->store(before);
        }
    }
}
