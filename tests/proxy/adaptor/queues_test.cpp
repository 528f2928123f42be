// SPDX-License-Identifier: Apache-2.0
// The queues of input ports that are connected with a mirrored output.
#include "peer_ports.hpp"
#include "scene.hpp"
#include "shm/inspect/observer.hpp"

#include <catch2/catch.hpp>

#include <InputDataPort.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

using namespace tandem;
using namespace std::chrono_literals;
using adaptor::test::Scene;

namespace {

using Input = InputDataPort<std::vector<double>>;

/// The counters as `tandem shm stats` shows them.
shm::RingCounters counters_of_reference(const Scene& scene) {
    const auto seen = shm::observe(scene.name);
    REQUIRE(seen);
    const auto& rings = seen->rings;
    const auto ring = std::find_if(rings.begin(), rings.end(),
                                   [](const auto& each) { return each.name == "port reference"; });
    REQUIRE(ring != rings.end());
    return ring->counters;
}

/// The first number of the next value; -1: there is none.
double pop_number(Input& input) {
    const std::unique_ptr<opros_any> value(input.pop());
    return value ? input.getContent(*value).at(0) : -1;
}
void push_number(Input& input, double number) {
    std::vector<double> value{number};
    input.push(value);
}
/// `length`: of the message; a long one goes by loan.
void send_number(Scene& scene, double number, std::uint32_t length = 1) {
    const std::vector<double> rest(length - 1);
    REQUIRE(scene.peer.link.writer("reference").write(0, [&](wire::CdrWriter& out) {
        out.put(length);
        out.put(number);
        for (const double zero : rest) out.put(zero);
    }));
}

} // namespace

TEST_CASE("an input port uses the queue that its component gave it, whoever sends") {
    const auto policy = GENERATE(OPROS_FIFO, OPROS_LAST, OPROS_LIFO, OPROS_UFIFO);
    const unsigned int limit = GENERATE(1, 4, 200);
    Scene scene("queue");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input across(policy, limit), local(policy, limit);
    REQUIRE(reference.checkType(&across));
    int number = 0;
    for (const int burst : {2, 5, 300, 1, 4}) {
        for (int i = 0; i < burst; ++i) {
            send_number(scene, ++number);
            push_number(local, number);
        }
        for (int i = 0; i < 3; ++i) REQUIRE(pop_number(across) == pop_number(local)); // and falls behind
    }
    const auto left = local.getSize();
    const auto counters = counters_of_reference(scene);
    while (local.getSize() != 0) REQUIRE(pop_number(across) == pop_number(local));
    CHECK(pop_number(across) == -1);
    if (policy == OPROS_FIFO) { // whose values stay in the ring
        CHECK(counters.sent == 312);
        CHECK(counters.waiting() == static_cast<std::uint64_t>(left));
        CHECK(counters.sent == counters.received + counters.skipped + counters.waiting());
    }
    reference.clearConnection();
}

TEST_CASE("an input port also uses its queue for messages in chunks") {
    Scene scene("queue-loan");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input input(OPROS_FIFO, 2);
    REQUIRE(reference.checkType(&input));
    constexpr std::uint32_t long_message = 20'000; // of two fifths of a ring's bytes
    for (int number = 1; number <= 3; ++number) send_number(scene, number, 2 * long_message);
    CHECK(pop_number(input) == 2);
    for (int number = 4; number <= 6; ++number) send_number(scene, number, number == 5 ? 1 : long_message);
    for (const double number : {5, 6, -1}) CHECK(pop_number(input) == number);
    const auto counters = counters_of_reference(scene);
    CHECK(counters.sent == counters.received + counters.dropped());
    reference.clearConnection();
}

TEST_CASE("values of the link and of a component of the host share one queue in order") {
    const auto policy = GENERATE(OPROS_FIFO, OPROS_LAST, OPROS_LIFO);
    Scene scene("queue-shared");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input input(policy, 4), local(policy, 4);
    REQUIRE(reference.checkType(&input));
    for (int number = 1; number <= 100; ++number) {
        push_number(local, number);
        if (number % 3 == 0)
            push_number(input, number);
        else
            send_number(scene, number);
        if (number % 7 == 0) REQUIRE(pop_number(input) == pop_number(local));
    }
    while (local.getSize() != 0) CHECK(pop_number(input) == pop_number(local));
    CHECK(pop_number(input) == -1);
    reference.clearConnection();
}

TEST_CASE("several input ports of one output each use the queue that their component gave them") {
    Scene scene("queues");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input across[] = {Input(OPROS_FIFO, 4), Input(OPROS_FIFO, 200), Input(OPROS_LAST, 1),
                      Input(OPROS_LIFO, 4)};
    Input local[] = {Input(OPROS_FIFO, 4), Input(OPROS_FIFO, 200), Input(OPROS_LAST, 1),
                     Input(OPROS_LIFO, 4)};
    const std::size_t ports = GENERATE(2, 3, 4);
    for (std::size_t i = 0; i < ports; ++i) REQUIRE(reference.checkType(&across[i]));
    int number = 0;
    for (const int burst : {3, 60, 300, 6}) {
        if (ports == 4 && burst > 60)
            continue; // of one that grows, 64 are kept for a target that does not read
        for (int i = 0; i < burst; ++i) {
            send_number(scene, ++number);
            for (std::size_t p = 0; p < ports; ++p) push_number(local[p], number);
        }
        for (std::size_t p = 0; p < ports; ++p)
            for (std::size_t i = 0; i <= 2 * p; ++i) REQUIRE(pop_number(across[p]) == pop_number(local[p]));
    }
    for (std::size_t p = 0; p < ports; ++p) {
        while (local[p].getSize() != 0) REQUIRE(pop_number(across[p]) == pop_number(local[p]));
        CHECK(pop_number(across[p]) == -1);
    }
    CHECK(counters_of_reference(scene).depth == (ports == 4 ? 0 : 200)); // all that any of them wants
    reference.clearConnection();
}

TEST_CASE("a sender that waits for room waits for room in the queue of the receiving port") {
    Scene scene("queue-wait");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input input(OPROS_FIFO, 4);
    REQUIRE(reference.checkType(&input));
    link::PortPolicy policy;
    policy.wait = 1ms;
    auto& writer = scene.peer.link.writer("reference");
    writer.set_policy(policy);
    for (int number = 1; number <= 4; ++number) send_number(scene, number);
    const auto send = [&] {
        return writer.write(0, [](wire::CdrWriter& out) {
            out.put<std::uint32_t>(1);
            out.put(5.0);
        });
    };
    CHECK_FALSE(send());
    CHECK(pop_number(input) == 1);
    CHECK(send());
    for (const double number : {2, 3, 4, 5, -1}) CHECK(pop_number(input) == number);
    reference.clearConnection();
}

namespace {

/// Lets the sender of "reference" wait up to `wait` for room.
link::ChannelWriter& waiting_writer(Scene& scene, std::chrono::milliseconds wait) {
    link::PortPolicy policy;
    policy.wait = wait;
    auto& writer = scene.peer.link.writer("reference");
    writer.set_policy(policy);
    return writer;
}

} // namespace

TEST_CASE("of several input ports, the slowest one loses no message of a sender that waits for room") {
    Scene scene("queues-wait");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input inputs[] = {Input(OPROS_FIFO, 4), Input(OPROS_FIFO, 200), Input(OPROS_UFIFO, 4)};
    for (auto& input : inputs) REQUIRE(reference.checkType(&input));
    waiting_writer(scene, link::max_wait);
    constexpr int count = 20'000;
    std::atomic<bool> stopped{false};
    std::vector<std::thread> readers;
    std::atomic<int> in_order[3]{};
    for (int i = 0; i < 3; ++i)
        readers.emplace_back([&, i] {
            for (int look = 0; !stopped && in_order[i] != count; ++look) {
                const double number = pop_number(inputs[i]);
                if (number == in_order[i] + 1) ++in_order[i];
                // One target reads in bursts, one counts the waiting messages before it reads, and one reads as fast as it can.
                if (i == 0 && look % 8 == 0) std::this_thread::sleep_for(100us);
                if (i == 1 && inputs[i].getSize() == 0) std::this_thread::yield();
            }
        });
    for (int number = 1; number <= count; ++number) send_number(scene, number);
    const bool all = link::test::eventually([&] {
        return std::all_of(std::begin(in_order), std::end(in_order), [](auto& n) { return n == count; });
    });
    stopped = true;
    for (auto& reader : readers) reader.join();
    INFO(in_order[0] << ", " << in_order[1] << ", " << in_order[2]);
    CHECK(all);
    const auto counters = counters_of_reference(scene);
    CHECK(counters.sent == count);
    CHECK(counters.received == count);
    CHECK(counters.lost() == 0);
    reference.clearConnection();
}

TEST_CASE("of several input ports, one that reads nothing loses messages, which are counted, and withholds "
          "none from the others") {
    Scene scene("queues-stopped");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input reading(OPROS_FIFO, 200), stopped(OPROS_FIFO, 4);
    REQUIRE(reference.checkType(&reading));
    REQUIRE(reference.checkType(&stopped));
    const bool waits = GENERATE(false, true);
    if (waits) waiting_writer(scene, 1ms);
    for (int number = 1; number <= 100; ++number) {
        send_number(scene, number);
        REQUIRE(pop_number(reading) == number);
    }
    CHECK(counters_of_reference(scene).discarded == 96);
    CHECK(counters_of_reference(scene).lost() == 96);
    for (const double number : {97, 98, 99, 100, -1}) CHECK(pop_number(stopped) == number);
    send_number(scene, 101);
    CHECK(pop_number(stopped) == 101);
    reference.clearConnection();
}

TEST_CASE(
    "values that a queue drops after they were received are counted, and a sender that waits loses none") {
    Scene scene("queue-discarded");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input input(OPROS_FIFO, 4);
    REQUIRE(reference.checkType(&input));
    const bool waits = GENERATE(false, true);
    if (waits) waiting_writer(scene, 1ms);
    for (int number = 1; number <= 4; ++number) send_number(scene, number);
    CHECK(input.getSize() == 4); // takes them into the queue
    for (int number = 5; number <= 8; ++number) send_number(scene, number);
    CHECK(input.getSize() == 4);
    for (int number = waits ? 1 : 5; number <= 8; ++number) REQUIRE(pop_number(input) == number);
    CHECK(pop_number(input) == -1);
    CHECK(counters_of_reference(scene).discarded == (waits ? 0 : 4));
    CHECK(counters_of_reference(scene).received == 8);
    // A component of the host displaces them, too.
    send_number(scene, 9);
    for (int number = 10; number <= 13; ++number) push_number(input, number);
    CHECK(pop_number(input) == 10);
    CHECK(counters_of_reference(scene).discarded == (waits ? 1 : 5));
    reference.clearConnection();
}

TEST_CASE("a component that takes one value per cycle sees that values wait behind its full queue") {
    Scene scene("queue-behind");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    Input input(OPROS_FIFO, 4);
    REQUIRE(reference.checkType(&input));
    waiting_writer(scene, 1ms);
    for (int number = 1; number <= 4; ++number) send_number(scene, number);
    CHECK(input.countWaiting() == 4);
    for (int number = 5; number <= 8; ++number) send_number(scene, number);
    for (std::size_t left = 8; left > 0; --left) {
        CHECK(input.countWaiting() == left);
        CHECK(pop_number(input) == 9.0 - static_cast<double>(left));
    }
    CHECK(input.countWaiting() == 0);
    reference.clearConnection();
}

TEST_CASE(
    "a push says that the queue across the link had no room, and without a peer that nothing was wrong") {
    adaptor::test::Wire wire("push-result", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad");
    auto& writer = wire.own.link.writer("in");
    adaptor::MirrorInPort position(wire.in, writer);
    opros_any value(std::vector<double>{1});
    REQUIRE(position.checkType(value));
    link::PortPolicy policy;
    policy.wait = 1ms;
    policy.length = 2;
    writer.set_policy(policy);
    CHECK(position.push(value) == OPROS_SUCCESS);
    CHECK(position.push(value) == OPROS_SUCCESS);
    CHECK(position.push(value) == OPROS_OUT_OF_RESOURCES);
    wire.received();
    CHECK(position.push(value) == OPROS_SUCCESS);
    wire.peer.link.close();
    CHECK(link::test::eventually([&] { return !writer.is_bound(); }));
    CHECK(position.push(value) == OPROS_SUCCESS);
}
