// SPDX-License-Identifier: Apache-2.0
// Values between two threads of a host: they go through a ring, without a lock that both threads take.
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include "tests/host/opros/runtime/archive_source.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/membarrier.hpp"

#include <InputDataPort.h>
#include <OutputDataPort.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <memory>
#include <thread>
#include <vector>

namespace {

using Values = std::vector<double>;

template <class T>
std::vector<T> drain(InputDataPort<T>& port) {
    std::vector<T> values;
    while (const std::unique_ptr<opros_any> any{port.pop()}) values.push_back(port.getContent(*any));
    return values;
}

/// In the form in which the engine connects two components.
struct LocalLink : IDataPortLink, tandem::rt::Rehearsable {
    explicit LocalLink(InputDataPortInterface& to) : destination(to) {}
    InputDataPortInterface& destination;
    ReturnType push(opros_any& data) override { return destination.push(data); }
    bool can_rehearse() const override { return destination.canRehearsePush(); }
    ReturnType setSource(DataPort*) override { return 0; }
    ReturnType addDestination(DataPort*) override { return 0; }
    ReturnType addDestination(RemoteDataPort*) override { return 0; }
    ReturnType removeDestination(DataPort*) override { return 0; }
    ReturnType removeDestination(RemoteDataPort*) override { return 0; }
    ReturnType clearDestination() override { return 0; }
    ReturnType clearSource() override { return 0; }
};

struct CountingListener : DataPortListener {
    void arrived() override { ++count; }
    int count = 0;
};

/// A component's port that processes pushed values itself.
struct OwnPort : InputDataPort<Values> {
    ReturnType push(opros_any& data) override {
        ++pushes;
        return InputDataPort<Values>::push(data);
    }
    int pushes = 0;
};

/// Counts its copies.
struct Counted {
    Counted() = default;
    Counted(const Counted&) { ++copies; }
    Counted& operator=(const Counted&) {
        ++copies;
        return *this;
    }
    static inline int copies = 0;
};

/// Accepts a value of any type.
struct TolerantPort : InputDataPort<Values> {
    bool checkType(opros_any&) override { return true; }
};

/// Never has a value.
struct EmptySource : DataPortSource {
    bool take(opros_any*) override { return false; }
};

} // namespace

TEST_CASE("a rehearsal of a push stores nothing, notifies nobody and calls no code of the component") {
    OutputDataPort<Values> out;
    InputDataPort<Values> in;
    OwnPort own;
    LocalLink to_in(in), to_own(own);
    CountingListener listener;
    in.setListener(&listener);
    out.addConnection(&to_in);
    out.addConnection(&to_own);
    const Values value{1, 2, 3};
    for (int i = 0; i < 100; ++i) out.push(value);
    REQUIRE(drain(in).size() == 15);
    drain(own);
    out.rehearse(); // allocates its sample
    const long before = allocations();
    for (int i = 0; i < 20; ++i) out.rehearse();
    CHECK(allocations() == before);
    CHECK(in.getSize() == 0);
    CHECK(listener.count == 100);
    CHECK(own.pushes == 100);
    CHECK(own.getSize() == 0);
    CHECK_FALSE(own.canRehearsePush());
    out.push(value);
    CHECK(allocations() == before);
    CHECK(drain(in) == std::vector<Values>{value});
}

TEST_CASE("a rehearsal of a pop takes nothing from a ring") {
    InputDataPort<Values> in;
    Values value{1, 2};
    for (int i = 0; i < 40; ++i) {
        in.push(value);
        delete in.pop();
    }
    in.push(value);
    in.rehearse();
    in.rehearse();
    CHECK(in.getSize() == 1);
    CHECK(drain(in) == std::vector<Values>{value});
    for (int i = 0; i < 10'000; ++i) CHECK(in.pop() == nullptr); // rehearses now and then
}

TEST_CASE("a rehearsal notes the cache lines of a pop") {
    const auto noted_by_rehearsal = [](InputDataPort<int>& port) {
        tandem::rt::CycleLines lines;
        tandem::rt::this_thread_lines = &lines;
        port.rehearse();
        tandem::rt::this_thread_lines = nullptr;
        return lines.count();
    };
    InputDataPort<int> polled, unused;
    // This thread becomes the owner of the consumer's mutex.
    for (int i = 0; i < 40; ++i) CHECK(polled.pop() == nullptr);
    if (tandem::test::mutexes_have_owners())
        CHECK(noted_by_rehearsal(polled) == 6); // port, implementation, mutex, ring, reader, cell
    CHECK(noted_by_rehearsal(unused) == 1);
}

TEST_CASE("reset empties a ring of any depth, and a port may accept an empty value") {
    struct Tolerant : InputDataPort<int> {
        using InputDataPort<int>::InputDataPort;
        bool checkType(opros_any&) override { return true; }
    };
    Tolerant port(OPROS_FIFO, 5000);
    int value = 1;
    for (int i = 0; i < 5000; ++i) port.push(value);
    port.reset();
    CHECK(port.getSize() == 0);
    opros_any nothing;
    CHECK(port.InputDataPort<int>::push(nothing) == OPROS_SUCCESS);
    const std::unique_ptr<opros_any> popped{port.pop()};
    REQUIRE(popped);
    CHECK(popped->empty());
}

TEST_CASE("a push to several readers copies the value once for each, and reading does not copy it") {
    constexpr std::size_t readers = 16;
    OutputDataPort<Counted> out;
    std::vector<std::unique_ptr<InputDataPort<Counted>>> ports;
    std::vector<std::unique_ptr<LocalLink>> links;
    for (std::size_t i = 0; i < readers; ++i) {
        ports.push_back(std::make_unique<InputDataPort<Counted>>(OPROS_FIFO, 2));
        links.push_back(std::make_unique<LocalLink>(*ports.back()));
        out.addConnection(links.back().get());
    }
    const Counted value;
    for (int i = 0; i < 10; ++i) out.push(value); // each slot gets its object
    Counted::copies = 0;
    out.push(value);
    CHECK(Counted::copies == readers);
    for (auto& port : ports) delete port->pop();
    CHECK(Counted::copies == readers);
}

TEST_CASE("a peeked value of a FIFO stays the next one until it is too old") {
    InputDataPort<int> port(OPROS_FIFO, 2);
    int value = 1;
    port.push(value);
    const auto peeked = [&] {
        const std::unique_ptr<opros_any> any(port.peek());
        return any ? port.getContent(*any) : 0;
    };
    CHECK(peeked() == 1);
    CHECK(port.getSize() == 1);
    port.push(value = 2);
    CHECK(peeked() == 1);
    CHECK(port.getSize() == 2);
    port.push(value = 3);
    CHECK(port.getSize() == 2);
    CHECK(peeked() == 2);
    CHECK(drain(port) == std::vector<int>{2, 3});
}

TEST_CASE("short and long vectors of a FIFO arrive whole and in order, even if peeked at or dropped") {
    InputDataPort<Values> port(OPROS_FIFO, 4);
    const auto vector = [](std::size_t size) { return Values(size, static_cast<double>(size)); };
    const auto push = [&](std::size_t size) {
        Values value = vector(size);
        port.push(value);
    };
    for (std::size_t size = 0; size < 12; ++size) push(size);
    const std::unique_ptr<opros_any> peeked(port.peek());
    REQUIRE(peeked);
    CHECK(port.getContent(*peeked) == vector(8));
    CHECK(drain(port) == std::vector<Values>{vector(8), vector(9), vector(10), vector(11)});
    for (const std::size_t size : {7U, 0U, 6U, 2U}) push(size);
    CHECK(drain(port) == std::vector<Values>{vector(7), vector(0), vector(6), vector(2)});
    const std::unique_ptr<opros_any> kept([&] {
        push(3);
        return port.pop();
    }());
    for (const std::size_t size : {5U, 9U}) { // neither overwrites a value that the consumer has
        push(size);
        delete port.pop();
    }
    CHECK(port.getContent(*kept) == vector(3));
}

TEST_CASE("a consumer may change the type of a value that it deletes") {
    InputDataPort<Values> port;
    const opros_any other =
        GENERATE(opros_any(std::string("text")), opros_any(std::vector<float>{7, 7}), opros_any());
    for (int i = 0; i < 4; ++i) {
        Values value(3, i);
        port.push(value);
        const std::unique_ptr<opros_any> popped(port.pop());
        REQUIRE(popped);
        CHECK(port.getContent(*popped) == value);
        opros_any(other).swap(*popped);
    }
}

TEST_CASE("a port that accepts several types gives each value with its own") {
    TolerantPort port;
    for (int i = 0; i < 4; ++i) {
        opros_any text(std::string("text")), values(Values(3, i));
        for (opros_any* pushed : {&text, &values}) {
            port.InputDataPort<Values>::push(*pushed);
            const std::unique_ptr<opros_any> popped(port.pop());
            REQUIRE(popped);
            CHECK(popped->type() == pushed->type());
        }
    }
}

TEST_CASE("a port for the last value has one from the first push on") {
    InputDataPort<Values> port(OPROS_LAST, 1);
    std::atomic<bool> stop{false};
    std::thread writer([&] {
        Values value(3);
        while (!stop) port.push(value);
    });
    int found = 0, missed = 0;
    while (found < 20'000) {
        if (port.getSize() == 0) continue;
        ++found;
        if (const std::unique_ptr<opros_any> value{port.pop()}; !value) ++missed;
    }
    stop = true;
    writer.join();
    CHECK(missed == 0);
}

TEST_CASE("values that wait stay in order when a port gets a source, loses it, or gets another queue") {
    InputDataPort<int> port;
    EmptySource source;
    int value = 0;
    for (int i = 1; i <= 3; ++i) port.push(value = i);
    REQUIRE(port.addSource(&source) == OPROS_SUCCESS);
    port.push(value = 4);
    CHECK(port.getSize() == 4);
    port.removeSource(&source);
    port.push(value = 5);
    CHECK(drain(port) == std::vector<int>{1, 2, 3, 4, 5});
    port.push(value);
    CHECK(port.setQueue(OPROS_LAST, 1) == OPROS_SUCCESS);
    CHECK(port.getSize() == 0);
    for (int i = 6; i <= 8; ++i) port.push(value = i);
    CHECK(drain(port) == std::vector<int>{8});
}

TEST_CASE("values of one thread arrive whole and in order while sources come and go") {
    InputDataPort<Values> port(OPROS_FIFO, 4);
    constexpr int last = 20'000;
    // Up to 6 numbers lie in the cells of the ring.
    const auto size_of = [](int number) { return static_cast<std::size_t>(1 + number % 9); };
    std::atomic<bool> done{false};
    std::thread pusher([&] {
        Values value;
        for (int i = 1; i <= last; ++i) {
            value.assign(size_of(i), i);
            port.push(value);
        }
    });
    std::thread changer([&] {
        while (!done) {
            EmptySource source;
            port.addSource(&source);
            std::this_thread::yield();
            port.removeSource(&source);
        }
    });
    double newest = 0;
    int faults = 0;
    while (newest != last)
        for (const Values& value : drain(port)) {
            const auto number = static_cast<int>(value.front());
            if (value.size() != size_of(number) || value.front() != value.back() || value.front() <= newest)
                ++faults;
            newest = value.front();
        }
    done = true;
    pusher.join();
    changer.join();
    CHECK(faults == 0);
}
