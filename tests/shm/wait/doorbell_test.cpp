// SPDX-License-Identifier: Apache-2.0
#include "tests/shm/fixture.hpp"

using namespace tandem::shm;
using namespace tandem::shm::test;

TEST_CASE("a doorbell returns all bits rung since the last wait") {
    Pair pair;
    pair.second->doorbell().poll();
    CHECK_FALSE(pair.second->doorbell().wait(0ns).any());
    pair.first->ring_peer(3);
    pair.first->ring_peer(61);
    pair.first->ring_peer(Doorbell::user_bits - 1);
    pair.first->peer_doorbell().ring_all({4, 5, 300});
    CHECK(pair.second->doorbell().wait(1s) == ReadyBits{3, 4, 5, 61, 300, Doorbell::user_bits - 1});
    CHECK_FALSE(pair.second->doorbell().wait(0ns).any());
}

TEST_CASE("joining, publishing and leaving ring the peer's attention bit") {
    Pair pair;
    const ReadyBits attention{Doorbell::attention_bit};
    CHECK(pair.first->doorbell().poll() == attention);
    pair.second->publish();
    CHECK(pair.first->doorbell().poll() == attention);
    pair.second.reset();
    CHECK(pair.first->doorbell().poll() == attention);
}

TEST_CASE("a wait ends at its bound in every mode") {
    const auto mode = GENERATE(WaitMode::spin, WaitMode::spin_then_futex, WaitMode::futex);
    Pair pair;
    pair.second->doorbell().poll();
    const auto before = now_ns();
    CHECK_FALSE(pair.second->doorbell().wait(3ms, {.mode = mode}).any());
    CHECK(now_ns() - before >= 3'000'000);
}

TEST_CASE("ringing makes no system call if the owner is awake, and one if it sleeps") {
    Pair pair;
    auto& bell = pair.first->peer_doorbell();
    pair.second->doorbell().poll();
    for (unsigned i = 0; i < 1000; ++i) CHECK_FALSE(bell.ring(i % Doorbell::user_bits));
    CHECK(bell.wakes() == 0);
    pair.second->doorbell().poll();
    std::atomic<bool> stop{false};
    std::thread sleeper([&] {
        while (!stop) pair.second->doorbell().wait(30s, {.mode = WaitMode::futex});
    });
    CHECK(eventually([&] {
        std::this_thread::sleep_for(1ms); // long enough to fall asleep, if the machine is not too busy
        const auto before = bell.wakes();
        const bool was_asleep = bell.ring(1);
        CHECK(was_asleep == (bell.wakes() == before + 1));
        return was_asleep;
    }));
    stop = true;
    bell.ring(1);
    sleeper.join();
}

TEST_CASE("an interrupt from another thread ends the wait") {
    Pair pair;
    ReadyBits bits;
    std::thread sleeper([&] {
        while (!bits.test(Doorbell::interrupt_bit)) bits |= pair.first->doorbell().wait(30s);
    });
    pair.first->doorbell().interrupt();
    sleeper.join();
    CHECK(bits.test(Doorbell::interrupt_bit));
}

TEST_CASE("no ring is lost between a waiter that falls asleep and a ringer") {
    const auto mode = GENERATE(WaitMode::spin_then_futex, WaitMode::futex);
    Pair pair;
    const std::size_t rounds = stress(20000);
    std::atomic<std::size_t> lost{0};
    pair.second->doorbell().poll(); // before the thread: a bell has one
    // Each side rings the other only after it was rung: one lost ring stops both.
    std::thread echo([&] {
        for (std::size_t i = 0; i < rounds && lost == 0; ++i) {
            while (!(pair.second->doorbell().wait(20s, {.mode = mode, .spin = 1us}).test(1)))
                if (++lost > 3) return;
            lost = 0;
            pair.second->ring_peer(2);
        }
    });
    bool answered = true;
    for (std::size_t i = 0; i < rounds && answered; ++i) {
        pair.first->ring_peer(1);
        ReadyBits bits;
        for (int tries = 0; tries < 3 && !bits.test(2); ++tries)
            bits |= pair.first->doorbell().wait(20s, {.mode = mode, .spin = 1us});
        answered = bits.test(2);
    }
    echo.join();
    CHECK(answered);
    CHECK(lost == 0);
}

TEST_CASE("an owner that polls its rings finds the message there, and no bit is set") {
    const auto mode = GENERATE(WaitMode::spin, WaitMode::spin_then_futex, WaitMode::futex);
    Pair pair;
    RingWriter writer(pair.first->add_ring("r", {}));
    pair.first->publish();
    RingReader reader(*pair.second->find_ring(Side::first, "r"));
    auto& mine = pair.second->doorbell();
    const auto ready = [&] { return !reader.empty(); };
    CHECK(mine.wait_for(ready, 0ns) == ReadyBits{Doorbell::attention_bit});
    const std::size_t rounds = stress(2000);
    std::thread sender([&] {
        for (std::size_t i = 0; i < rounds; ++i) {
            writer.write(bytes_of("x"), i);
            pair.first->ring_peer(5);
            eventually([&] { return writer.counters().waiting() == 0; });
        }
    });
    std::size_t got = 0, other = 0;
    for (std::size_t waits = 0; got < rounds && waits < 2 * rounds; ++waits) {
        if (mine.wait_for(ready, 20s, {.mode = mode}).any()) ++other;
        while (reader.read()) ++got;
    }
    sender.join();
    CHECK(got == rounds);
    CHECK(other == 0);
    // Back to bits: each port may have news now, once.
    const ReadyBits all = mine.poll();
    CHECK((all.test(0) && all.test(5) && all.test(Doorbell::user_bits - 1)));
    CHECK_FALSE(all.test(Doorbell::attention_bit));
    CHECK_FALSE(mine.poll().any());
    pair.first->ring_peer(7);
    CHECK(mine.poll() == ReadyBits{7});
}

TEST_CASE("waiting for a ring ends at its bound and at an interrupt in every mode") {
    const auto mode = GENERATE(WaitMode::spin, WaitMode::spin_then_futex, WaitMode::futex);
    Pair pair;
    pair.second->doorbell().poll();
    const auto never = [] { return false; };
    const auto before = now_ns();
    CHECK_FALSE(pair.second->doorbell().wait_for(never, 3ms, {.mode = mode}).any());
    CHECK(now_ns() - before >= 3'000'000);
    std::thread other([&] { pair.second->doorbell().interrupt(); });
    CHECK(pair.second->doorbell().wait_for(never, 20s, {.mode = mode}) == ReadyBits{Doorbell::interrupt_bit});
    other.join();
}
