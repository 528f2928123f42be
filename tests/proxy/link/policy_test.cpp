// SPDX-License-Identifier: Apache-2.0
// Settings of single ports: keep_last, wait_ms and deadline_ms.
#include "tests/proxy/link/link_side.hpp"
#include "tests/support/membarrier.hpp"

#include <map>
#include <thread>

using namespace tandem;
using namespace tandem::link;
using namespace tandem::link::test;

namespace {

bool send_number(ChannelWriter& writer, double number) {
    return writer.write(1, [&](wire::CdrWriter& out) { out.put(number); });
}
std::optional<double> receive_number(ChannelReader& reader) {
    std::optional<double> number;
    reader.read(false,
                [&](const shm::Record& record) { number = wire::CdrReader(record.bytes).get<double>(); });
    return number;
}

PortPolicy keep_last() {
    PortPolicy policy;
    policy.keep_last = true;
    return policy;
}

std::unique_ptr<LinkSide> side(shm::Side which, const std::string& name, const PortTable& table = {},
                               std::size_t ring_bytes = std::size_t{256} * 1024) {
    LinkOptions options;
    options.name = name;
    options.rings.ring_bytes = ring_bytes;
    auto made = std::make_unique<LinkSide>(which, options, table);
    made->link.open();
    return made;
}

} // namespace

TEST_CASE("a peer that returns gets the last value of ports with keep_last, once, and of no others") {
    const auto name = unique_name("last");
    auto a = side(shm::Side::second, name, joystick_table());
    a->link.writer("reference").set_policy(keep_last());
    for (int round = 0; round < 2; ++round) {
        auto b = side(shm::Side::first, name);
        wait_until_up(*a, *b);
        if (round == 0) {
            CHECK(b->link.reader("reference").empty());
            for (const double value : {1.0, 2.0, 3.0})
                REQUIRE(send_number(a->link.writer("reference"), value));
            REQUIRE(send_number(b->link.writer("position"), 5));
        } else {
            CHECK(receive_number(b->link.reader("reference")) == 3);
            CHECK_FALSE(receive_number(b->link.reader("reference")));
            CHECK_FALSE(receive_number(a->link.reader("position")));
        }
        b.reset();
        CHECK(eventually([&] { return !a->link.is_up(); }));
    }
}

TEST_CASE("a port that waits for room loses nothing while its reader reads, and drops the newest when it "
          "does not") {
    const auto name = unique_name("wait");
    auto a = side(shm::Side::second, name, joystick_table(), std::size_t{16} * 1024);
    auto b = side(shm::Side::first, name);
    wait_until_up(*a, *b);
    auto& writer = a->link.writer("reference");
    auto& reader = b->link.reader("reference");
    PortPolicy policy;
    policy.wait = max_wait;
    writer.set_policy(policy);
    constexpr int count = 3000; // many times what the ring holds
    std::thread consumer([&] {
        for (int next = 0; next < count;)
            if (const auto number = receive_number(reader)) {
                if (*number != next) return; // one was lost
                ++next;
            } else {
                std::this_thread::sleep_for(100us);
            }
    });
    for (int i = 0; i < count; ++i) send_number(writer, i);
    consumer.join();
    auto counters = reader.counters();
    CHECK(counters.received == count);
    CHECK(counters.dropped() == 0);
    // Without a reader, the oldest messages are kept, and each later one is refused and counted after the wait.
    policy.wait = 1ms;
    writer.set_policy(policy);
    int sent = 0;
    while (send_number(writer, sent)) ++sent;
    CHECK_FALSE(send_number(writer, -1));
    CHECK(receive_number(reader) == 0);
    counters = reader.counters();
    CHECK(counters.refused == 2);
    CHECK(counters.overwritten == 0);
}

TEST_CASE("a silence beyond a port's deadline is counted once, and again after the next message") {
    const auto name = unique_name("deadline");
    auto a = side(shm::Side::second, name, joystick_table());
    auto b = side(shm::Side::first, name);
    wait_until_up(*a, *b);
    auto& reader = b->link.reader("reference");
    CHECK(reader.missed_deadlines() == 0);
    PortPolicy policy;
    policy.deadline = 20ms;
    reader.set_policy(policy);
    CHECK(eventually([&] { return reader.missed_deadlines() == 1; }));
    std::this_thread::sleep_for(100ms);
    CHECK(reader.missed_deadlines() == 1); // the same silence
    REQUIRE(send_number(a->link.writer("reference"), 1));
    CHECK(eventually([&] { return reader.missed_deadlines() == 2; }));
    CHECK(reader.counters().missed_deadlines == 2); // in the segment, for observers
    b->link.close();
    CHECK(b->missed == std::vector<std::string>{"reference", "reference"});
}

TEST_CASE("a queue holds as many messages as its length, and drops the oldest or the newest according to its "
          "policy") {
    const auto name = unique_name("length");
    auto a = side(shm::Side::second, name, joystick_table());
    auto b = side(shm::Side::first, name);
    wait_until_up(*a, *b);
    auto& writer = a->link.writer("reference");
    auto& reader = b->link.reader("reference");
    PortPolicy policy;
    QueuePolicy queue;
    queue.length = 3;
    SECTION("overwrite") {
        add_queue_policy(queue, policy);
        writer.set_policy(policy);
        reader.set_depth(queue.reader_depth());
        for (int i = 0; i < 10; ++i) CHECK(send_number(writer, i));
        CHECK(reader.counters().waiting() == 3);
        for (const double expected : {7, 8, 9}) CHECK(receive_number(reader) == expected);
        CHECK_FALSE(receive_number(reader));
        for (int i = 10; i < 12; ++i) CHECK(send_number(writer, i));
        CHECK(receive_number(reader) == 10);
        CHECK(reader.counters().skipped == 7);
    }
    SECTION("refuse") {
        queue.full = GENERATE(QueuePolicy::Full::refuse, QueuePolicy::Full::wait); // for no time
        add_queue_policy(queue, policy);
        writer.set_policy(policy);
        reader.set_depth(queue.reader_depth());
        for (int i = 0; i < 10; ++i) CHECK(send_number(writer, i) == (i < 3));
        CHECK(receive_number(reader) == 0);
        CHECK(send_number(writer, 10));
        CHECK_FALSE(send_number(writer, 11));
        for (const double expected : {1, 2, 10}) CHECK(receive_number(reader) == expected);
        CHECK(reader.counters().refused == 8);
    }
    SECTION("wait") {
        queue.full = QueuePolicy::Full::wait;
        queue.wait_ms = 1;
        add_queue_policy(queue, policy);
        writer.set_policy(policy);
        for (int i = 0; i < 4; ++i) CHECK(send_number(writer, i) == (i < 3));
        policy.wait = max_wait;
        writer.set_policy(policy);
        std::thread consumer([&] {
            while (!receive_number(reader)) std::this_thread::sleep_for(1ms);
        });
        CHECK(send_number(writer, 4));
        consumer.join();
        CHECK(reader.counters().refused == 1);
    }
    SECTION("wait, for a queue whose length only the reader knows") {
        reader.set_depth(3);
        policy.wait = 1ms;
        writer.set_policy(policy);
        for (int i = 0; i < 4; ++i) CHECK(send_number(writer, i) == (i < 3));
        for (const double expected : {0, 1, 2}) CHECK(receive_number(reader) == expected);
        CHECK(reader.counters().refused == 1);
    }
    const auto counters = reader.counters();
    CHECK(counters.sent == counters.received + counters.dropped() + counters.waiting());
}

TEST_CASE("a reader keeps its depth and its last message when the peer returns") {
    const auto name = unique_name("depth");
    auto a = side(shm::Side::second, name, joystick_table());
    auto& reader = a->link.reader("position");
    reader.set_depth(2);
    const auto again = [&]() -> std::optional<double> {
        const std::lock_guard lock(reader.mutex());
        const auto* const record = reader.again_locked();
        return record ? std::optional(wire::CdrReader(record->bytes).get<double>()) : std::nullopt;
    };
    CHECK_FALSE(again());
    for (int round = 0; round < 2; ++round) {
        auto b = side(shm::Side::first, name);
        wait_until_up(*a, *b);
        if (round == 1) CHECK(again() == 5);
        for (int i = 0; i < 6; ++i) REQUIRE(send_number(b->link.writer("position"), i));
        CHECK(receive_number(reader) == 4);
        CHECK(receive_number(reader) == 5);
        CHECK_FALSE(receive_number(reader));
        CHECK(again() == 5);
        b.reset();
        CHECK(eventually([&] { return !a->link.is_up(); }));
        CHECK(again() == 5);
    }
}

TEST_CASE("settings of one port take precedence over those of all ports") {
    std::map<std::string, std::string> settings{
        {"keep_last", "1"}, {"keep_last.b", "0"}, {"deadline_ms.b", "50"}, {"wait_ms", "100000"}};
    const auto policy = [&](const std::string& port) {
        return read_port_policy("property", port, [&](const std::string& name) { return settings[name]; });
    };
    CHECK(policy("a").keep_last);
    CHECK_FALSE(policy("b").keep_last);
    CHECK(policy("a").deadline == 0ms);
    CHECK(policy("b").deadline == 50ms);
    CHECK(policy("a").wait == max_wait);
    settings["deadline_ms.a"] = "soon";
    CHECK_THROWS_WITH(policy("a"), Catch::Contains("'deadline_ms.a' is 'soon'"));
}

TEST_CASE("a supervisor that checks deadlines does not take the lock of a port without one") {
    const auto name = unique_name("owner");
    auto a = side(shm::Side::second, name, joystick_table());
    auto b = side(shm::Side::first, name);
    wait_until_up(*a, *b);
    ChannelReader& reader = b->link.reader("reference");
    std::thread([&] {
        for (int i = 0; i < 200; ++i) {
            CHECK_FALSE(reader.has_missed_deadline(std::chrono::steady_clock::now()));
            CHECK(reader.deadline_check_in() == shm::longest_wait);
        }
    }).join();
    for (int i = 0; i < 100; ++i) {
        REQUIRE(send_number(a->link.writer("reference"), i));
        REQUIRE(receive_number(reader) == i);
    }
    double again = -1;
    const bool is_owner = reader.mutex().lock_if_owner();
    if (is_owner) {
        const rt::ShortLock lock(reader.mutex(), std::adopt_lock);
        const rt::Rehearsal rehearsal;
        again = wire::CdrReader(reader.read_locked()->bytes).get<double>();
    }
    CHECK(is_owner == tandem::test::mutexes_have_owners());
    CHECK(again == (is_owner ? 99 : -1));
    CHECK_FALSE(receive_number(reader));
}
