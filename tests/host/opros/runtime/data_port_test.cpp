// SPDX-License-Identifier: Apache-2.0
#include "host/rt/rehearsal.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/membarrier.hpp"
#include "tests/support/skip.hpp"

#include <InputDataPort.h>
#include <OutputDataPort.h>

#include <catch2/catch.hpp>
#include <memory>
#include <thread>

namespace {

template <typename T>
std::vector<T> drain(InputDataPort<T>& port) {
    std::vector<T> values;
    while (std::unique_ptr<opros_any> any{port.pop()}) values.push_back(port.getContent(*any));
    return values;
}

struct DirectLink : IDataPortLink {
    explicit DirectLink(DataPort& to) : destination(to) {}
    DataPort& destination;
    ReturnType push(opros_any& data) override { return destination.push(data); }
    ReturnType setSource(DataPort*) override { return 0; }
    ReturnType addDestination(DataPort*) override { return 0; }
    ReturnType addDestination(RemoteDataPort*) override { return 0; }
    ReturnType removeDestination(DataPort*) override { return 0; }
    ReturnType removeDestination(RemoteDataPort*) override { return 0; }
    ReturnType clearDestination() override { return 0; }
    ReturnType clearSource() override { return 0; }
};

/// In the form of a bridge.
struct RehearsableLink : DirectLink, tandem::rt::Rehearsable {
    using DirectLink::DirectLink;
    ReturnType push(opros_any& data) override {
        if (!tandem::rt::rehearsing()) return DirectLink::push(data);
        ++rehearsals;
        types_match = data.holds<std::vector<double>>();
        return OPROS_SUCCESS;
    }
    int rehearsals = 0;
    bool types_match = false;
};
} // namespace

TEST_CASE("FIFO, the default, gives out the oldest value first and drops the oldest when it is full") {
    InputDataPort<int> port;
    for (int i = 1; i <= 17; ++i) port.push(i);
    CHECK(port.getSize() == 15);
    const auto values = drain(port);
    CHECK(values.front() == 3);
    CHECK(values.back() == 17);
}

TEST_CASE("LAST keeps the newest only") {
    InputDataPort<int> port(OPROS_LAST, 1);
    for (int i = 1; i <= 3; ++i) port.push(i);
    CHECK(drain(port) == std::vector<int>{3});
}

TEST_CASE("LIFO gives out the newest value first and loses none") {
    InputDataPort<int> port(OPROS_LIFO, 1);
    for (int i = 1; i <= 3; ++i) port.push(i);
    CHECK(drain(port) == std::vector<int>{3, 2, 1});
}

TEST_CASE("UFIFO grows, even after it has wrapped around") {
    InputDataPort<int> port(OPROS_UFIFO, 2);
    int value = 0;
    port.push(++value);
    delete port.pop();
    for (int i = 0; i < 9; ++i) port.push(++value);
    CHECK(drain(port) == std::vector<int>{2, 3, 4, 5, 6, 7, 8, 9, 10});
}

TEST_CASE("peek leaves a value in the queue and pop removes it") {
    InputDataPort<std::string> port;
    CHECK(port.peek() == nullptr);
    CHECK(port.pop() == nullptr);
    std::string text = "x";
    port.push(text);
    const std::unique_ptr<opros_any> seen(port.peek()), taken(port.pop());
    CHECK(port.getContent(*seen) == "x");
    CHECK(*port.getContentPointer(*taken) == "x");
    CHECK(port.getSize() == 0);
}

TEST_CASE("a value of another type is refused") {
    InputDataPort<double> port;
    opros_any wrong = std::string("no number"), empty;
    CHECK(port.push(wrong) == OPROS_BAD_INPUT_PARAMETER);
    CHECK(port.push(empty) == OPROS_BAD_INPUT_PARAMETER);
    CHECK(port.getSize() == 0);
    CHECK_FALSE(port.checkType(wrong));
    CHECK_THROWS_AS(port.getContent(wrong), std::bad_cast);
    CHECK(port.getContentPointer(wrong) == nullptr);
    OutputDataPort<double> out;
    CHECK(out.push(wrong) == OPROS_BAD_INPUT_PARAMETER);
}

TEST_CASE("ports compare types by asking each other") {
    OutputDataPort<std::vector<double>> out;
    InputDataPort<std::vector<double>> same;
    InputDataPort<std::vector<float>> other;
    CHECK(out.checkType(&same));
    CHECK_FALSE(out.checkType(&other));
    CHECK(out.sample().type() == "std::vector<double>");
    CHECK(other.typeError().empty());
}

TEST_CASE("a push reaches every destination, and none without a link") {
    OutputDataPort<std::string> out;
    CHECK(out.push("lost") == OPROS_SUCCESS);
    InputDataPort<std::string> a, b;
    DirectLink to_a(a), to_b(b);
    out.addConnection(&to_a);
    out.addConnection(&to_a);
    out.addConnection(&to_b);
    out.push("text");
    CHECK(drain(a) == std::vector<std::string>{"text"});
    CHECK(drain(b) == std::vector<std::string>{"text"});
    out.removeConnection(&to_a);
    out.push("more");
    CHECK(a.getSize() == 0);
    out.clearConnection();
    out.push("nobody");
    CHECK(b.getSize() == 1);
}

TEST_CASE("a rehearsal reaches bridges in the thread that pushes, and delivers nothing") {
    OutputDataPort<std::vector<double>> out;
    InputDataPort<std::vector<double>> queue, behind_bridge;
    DirectLink link(queue);
    RehearsableLink bridge(behind_bridge);
    out.addConnection(&link);
    out.addConnection(&bridge);
    out.rehearse();
    CHECK(bridge.rehearsals == 0); // nobody has pushed yet
    const std::vector<double> value{1, 2};
    for (int i = 0; i < 100; ++i) out.push(value);
    drain(queue);
    drain(behind_bridge);
    std::thread([&] { out.rehearse(); }).join();
    CHECK(bridge.rehearsals == 0);
    if (!tandem::test::mutexes_have_owners()) TANDEM_SKIP("membarrier(2) is not permitted");
    out.rehearse();
    CHECK(bridge.rehearsals == 1);
    CHECK(bridge.types_match);
    CHECK(drain(queue).empty());
    CHECK(drain(behind_bridge).empty());
    const auto before = allocations();
    out.rehearse();
    CHECK(allocations() == before);
}

TEST_CASE("reset empties the queue") {
    InputDataPort<int> port;
    int value = 1;
    port.push(value);
    port.reset();
    CHECK(port.pop() == nullptr);
}

TEST_CASE("after the first three values of a LAST, a push allocates nothing, and a pop only the object it "
          "returns") {
    OutputDataPort<std::vector<double>> out;
    InputDataPort<std::vector<double>> in(OPROS_LAST, 1);
    DirectLink link(in);
    out.addConnection(&link);
    const std::vector<double> value(100, 1.5);
    for (int i = 0; i < 3; ++i) out.push(value); // the queue's, and one for each thread
    const long before = allocations();
    for (int i = 0; i < 10; ++i) out.push(value);
    CHECK(allocations() == before);
    delete in.pop();
    CHECK(allocations() - before <= 3); // the any, its holder, the vector's elements
}

TEST_CASE("many threads may push while one pops") {
    InputDataPort<int> port(OPROS_UFIFO, 1);
    std::vector<std::thread> writers;
    for (int t = 0; t < 4; ++t)
        writers.emplace_back([&] {
            for (int i = 0; i < 1000; ++i) port.push(i);
        });
    std::size_t seen = 0;
    while (seen < 4000) seen += drain(port).size();
    for (auto& writer : writers) writer.join();
    CHECK(seen == 4000);
}

TEST_CASE("setQueue replaces a default queue but not one that the code has chosen") {
    InputDataPort<int> open, named("name"), chosen(OPROS_FIFO, 3);
    CHECK(open.setQueue(OPROS_LAST, 1) == OPROS_SUCCESS);
    CHECK(named.setQueue(OPROS_FIFO, 2) == OPROS_SUCCESS);
    CHECK(chosen.setQueue(OPROS_LAST, 1) == OPROS_PRECONDITION_NOT_MET);
    for (int i = 1; i <= 5; ++i)
        for (InputDataPort<int>* port : {&open, &named, &chosen}) port->push(i);
    CHECK(drain(open) == std::vector<int>{5});
    CHECK(drain(named) == std::vector<int>{4, 5});
    CHECK(drain(chosen) == std::vector<int>{3, 4, 5});
}

TEST_CASE("a listener is notified of each pushed value") {
    struct Count : DataPortListener {
        int arrivals = 0;
        void arrived() override { ++arrivals; }
    } count;
    InputDataPort<int> port;
    port.setListener(&count);
    int value = 1;
    port.push(value);
    port.push(value);
    opros_any wrong(1.5);
    port.push(wrong);
    CHECK(count.arrivals == 2);
    port.setListener(nullptr);
    port.push(value);
    CHECK(count.arrivals == 2);
}

TEST_CASE("a push returns the failure of a receiver, and the others get the value") {
    struct FullLink : DirectLink {
        using DirectLink::DirectLink;
        ReturnType push(opros_any&) override { return result; }
        ReturnType result = OPROS_OUT_OF_RESOURCES;
    };
    OutputDataPort<int> out;
    InputDataPort<int> first, last;
    DirectLink to_first(first), to_last(last);
    FullLink full(first);
    for (IDataPortLink* link : {static_cast<IDataPortLink*>(&to_first), static_cast<IDataPortLink*>(&full),
                                static_cast<IDataPortLink*>(&to_last)})
        out.addConnection(link);
    CHECK(out.push(1) == OPROS_OUT_OF_RESOURCES);
    full.result = OPROS_SUCCESS;
    CHECK(out.push(2) == OPROS_SUCCESS);
    full.result = OPROS_BAD_INPUT_PARAMETER;
    CHECK(out.push(3) == OPROS_BAD_INPUT_PARAMETER);
    CHECK(drain(first) == std::vector<int>{1, 2, 3});
    CHECK(drain(last) == std::vector<int>{1, 2, 3});
    out.clearConnection();
}
