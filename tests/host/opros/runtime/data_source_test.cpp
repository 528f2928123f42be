// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/runtime/test_sources.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/membarrier.hpp"
#include "tests/support/skip.hpp"

#include <InputDataPort.h>

#include <catch2/catch.hpp>
#include <memory>
#include <thread>

namespace {

double pop(InputDataPort<double>& port) {
    const std::unique_ptr<opros_any> any(port.pop());
    return any ? port.getContent(*any) : -1;
}

} // namespace

TEST_CASE("with LAST the consumer gets the newest value of a source, and the others are dropped") {
    InputDataPort<double> port(OPROS_LAST, 1);
    TestSource source;
    REQUIRE(port.addSource(&source) == OPROS_SUCCESS);
    CHECK(port.pop() == nullptr);
    for (double value : {1., 2., 3.}) source.send(value);
    CHECK(pop(port) == 3);
    CHECK(source.finished == 3);
    CHECK(port.pop() == nullptr);
}

TEST_CASE("a source is told how many values the queue holds, even if a profile replaces the queue") {
    struct : TestSource {
        void setDepth(std::size_t values) override { depth = values; }
        std::size_t depth = 99;
    } source;
    const auto depth_of = [&](DataPortPolicy policy, unsigned int limit) {
        InputDataPort<double> port(policy, limit);
        port.addSource(&source);
        return source.depth;
    };
    CHECK(depth_of(OPROS_FIFO, 4) == 4);
    CHECK(depth_of(OPROS_FIFO, 0) == 1);
    CHECK(depth_of(OPROS_LAST, 4) == 1);
    CHECK(depth_of(OPROS_UFIFO, 4) == 0);
    CHECK(depth_of(OPROS_LIFO, 4) == 0);
    InputDataPort<double> unset;
    unset.addSource(&source);
    CHECK(source.depth == DEFAULT_QUEUE_LIMIT);
    REQUIRE(unset.setQueue(OPROS_FIFO, 3) == OPROS_SUCCESS);
    CHECK(source.depth == 3);
}

TEST_CASE("values of sources fill the queue like pushed ones, whichever reader checks it, and at any time") {
    const auto policy = GENERATE(OPROS_FIFO, OPROS_LAST, OPROS_LIFO, OPROS_UFIFO);
    const unsigned int limit = GENERATE(1, 4);
    const int sources = GENERATE(1, 2);
    InputDataPort<double> port(policy, limit), pushed(policy, limit);
    // Like a link's source, which itself drops what is beyond the depth.
    struct Bounded : TestSource {
        void setDepth(std::size_t values) override { depth = values; }
        void send_bounded(double value) {
            send(value);
            if (depth != 0 && waiting.size() > depth) waiting.pop_front();
        }
        std::size_t depth = 0;
    } source[2];
    for (int i = 0; i < sources; ++i) port.addSource(&source[i]);
    unsigned random = 1;
    for (int value = 1; value < 400; ++value) {
        random = random * 1103515245 + 12345;
        const auto choice = random >> 16U;
        double number = value;
        pushed.push(number);
        if (choice % 3 == 0)
            port.push(number); // by a component of the same host
        else if (choice % 3 == 1 || sources == 1)
            source[0].send_bounded(number);
        else if (port.getSize(); true) // only reading shows the order of values from several sources
            source[1].send_bounded(number);
        if (sources == 2) port.getSize();
        if (choice % 7 == 0) {
            const std::unique_ptr<opros_any> first(port.peek()), expected(pushed.peek());
            REQUIRE(port.getContent(*first) == pushed.getContent(*expected));
        }
        if (choice % 11 == 0) REQUIRE(port.getSize() == pushed.getSize());
        if (choice % 5 == 0) REQUIRE(pop(port) == pop(pushed));
    }
    while (pushed.getSize() != 0) REQUIRE(pop(port) == pop(pushed));
    CHECK(port.pop() == nullptr);
}

TEST_CASE("a consumer of one source gets each value with one call of next() and all in order") {
    InputDataPort<double> port(OPROS_FIFO, 4);
    TestSource source;
    port.addSource(&source);
    CHECK(port.pop() == nullptr);
    for (double value : {1., 2., 3.}) source.send(value);
    source.next_calls = 0;
    CHECK(pop(port) == 1);
    CHECK(source.next_calls == 1);
    CHECK(pop(port) == 2);
    CHECK(source.next_calls == 2);
    CHECK(port.getSize() == 1); // which moves what waits outside into the queue
    CHECK(source.waiting.empty());
    source.send(4);
    CHECK(pop(port) == 3);
    CHECK(pop(port) == 4);
    CHECK(port.pop() == nullptr);
}

TEST_CASE("a consumer of several sources that lags behind gets all values of each in order") {
    InputDataPort<double> port(OPROS_FIFO, 16);
    TestSource one, other;
    port.addSource(&one);
    port.addSource(&other);
    CHECK(port.pop() == nullptr);
    for (double value : {1., 2., 3.}) one.send(value);
    for (double value : {11., 12.}) other.send(value);
    CHECK(pop(port) == 1);
    CHECK(pop(port) == 2); // it lags behind, so what waits outside is fetched in
    CHECK((one.waiting.empty() && other.waiting.empty()));
    for (double value : {3., 11., 12.}) CHECK(pop(port) == value);
    CHECK(port.pop() == nullptr);
}

TEST_CASE("a waiting consumer gets the values of all its sources and those that are pushed") {
    InputDataPort<double> port;
    TestSource one, other;
    port.addSource(&one);
    port.addSource(&other);
    CHECK(port.pop() == nullptr);
    other.send(1);
    CHECK(pop(port) == 1);
    CHECK(port.pop() == nullptr);
    double pushed = 2;
    port.push(pushed);
    CHECK(pop(port) == 2);
    CHECK(port.pop() == nullptr);
    one.waiting.push_back("junk");
    one.send(3);
    CHECK(pop(port) == 3);
    CHECK(one.finished == 2);
}

TEST_CASE(
    "a value that waits alone is counted in its source, and several are taken over as the policy says") {
    class Counting : public TestSource {
      public:
        long waiting() override { return static_cast<long>(TestSource::waiting.size()); }
    };
    Counting first, second;
    InputDataPort<double> port(OPROS_FIFO, 2);
    REQUIRE(port.addSource(&first) == OPROS_SUCCESS);
    REQUIRE(port.addSource(&second) == OPROS_SUCCESS);
    CHECK(port.countWaiting() == 0);
    second.send(1);
    CHECK(port.countWaiting() == 1);
    CHECK(first.next_calls + second.next_calls == 0);
    first.send(2);
    CHECK(port.countWaiting() == 2);
    CHECK(first.finished + second.finished == 2);
    second.send(3);
    CHECK(port.countWaiting() == 2); // full: the oldest has given way
    CHECK(second.TestSource::waiting.empty());
    TestSource uncounted;
    InputDataPort<double> other;
    REQUIRE(other.addSource(&uncounted) == OPROS_SUCCESS);
    uncounted.send(4);
    CHECK(other.countWaiting() == 1);
    CHECK(uncounted.finished == 1);
}

TEST_CASE("a popped value does not change when others arrive") {
    InputDataPort<double> port;
    TestSource source;
    port.addSource(&source);
    std::vector<std::unique_ptr<opros_any>> kept;
    for (double value : {1., 2., 3.}) {
        CHECK(port.pop() == nullptr);
        source.send(value);
        kept.emplace_back(port.pop());
    }
    for (std::size_t i = 0; i < kept.size(); ++i)
        CHECK(port.getContent(*kept[i]) == static_cast<double>(i + 1));
}

TEST_CASE("popped values may be kept in any number and deleted by another thread after their port") {
    std::vector<std::unique_ptr<opros_any>> kept;
    {
        InputDataPort<double> port(OPROS_FIFO, 16);
        for (double value = 0; value < 10; ++value) {
            port.push(value);
            kept.emplace_back(port.pop());
            if (value == 4) kept[1].reset(); // in between, one is given back
        }
        CHECK(port.getContent(*kept[9]) == 9);
    }
    std::thread([&] {
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (i != 1) CHECK(*opros_any_cast<double>(kept[i].get()) == static_cast<double>(i));
        kept.clear();
    }).join();
}

TEST_CASE("after two values, a waiting consumer gets and deletes a value without an allocation except for "
          "decoding") {
    InputDataPort<std::vector<double>> port;
    const std::vector<double> values(100, 1.5);
    std::vector<double> decoded = values;
    RepeatingSource source(values);
    port.addSource(&source);
    for (int i = 0; i < 5; ++i) {
        CHECK(port.pop() == nullptr);
        source.ready = true;
        const long before = allocations();
        *source.next() >> decoded;
        const long between = allocations();
        const std::unique_ptr<opros_any> any(port.pop());
        const long after = allocations();
        if (i > 1) CHECK(after - between == between - before);
        CHECK(port.getContent(*any) == values);
    }
}

TEST_CASE("a large value is decoded into the object that the consumer gets and never copied") {
    const auto policy = GENERATE(OPROS_FIFO, OPROS_LAST, OPROS_LIFO, OPROS_UFIFO);
    InputDataPort<Picture> port(policy, 4);
    PictureSource source;
    port.addSource(&source);
    Picture::copies = 0;
    for (unsigned char round = 1; round <= 5; ++round) {
        for (int i = 0; i < 3; ++i)
            source.take(round); // it waits for the first one, and lags behind with the rest
        std::size_t popped = 0;
        while (const std::unique_ptr<opros_any> any{port.pop()}) {
            const auto* picture = port.getContentPointer(*any);
            REQUIRE(picture);
            CHECK(picture->pixels == std::vector<unsigned char>(1000, round));
            ++popped;
        }
        CHECK(popped == (policy == OPROS_LAST ? 1 : 3));
    }
    CHECK(Picture::copies == 0);
}

TEST_CASE("pushed values and those of a source share one queue") {
    InputDataPort<double> port;
    TestSource source;
    port.addSource(&source);
    double pushed = 7;
    port.push(pushed);
    source.send(8);
    CHECK(pop(port) == 7);
    CHECK(pop(port) == 8);
}

TEST_CASE("a value that cannot be decoded is dropped and reported, and no other value is lost") {
    InputDataPort<double> port(OPROS_LAST, 1);
    TestSource source;
    port.addSource(&source);
    source.send(5);
    source.waiting.push_back("junk");
    CHECK(pop(port) == 5);
    CHECK_FALSE(source.error.empty());
    CHECK(source.finished == 2);
}

TEST_CASE("a source that can signal its values is given the port's listener and is not polled") {
    struct Signalling : TestSource {
        bool setListener(DataPortListener* to) override {
            listener = to;
            return true;
        }
        DataPortListener* listener = nullptr;
    } signalling;
    struct Count : DataPortListener {
        void arrived() override {}
    } count;
    const bool listener_first = GENERATE(true, false);
    InputDataPort<double> port;
    if (listener_first) port.setListener(&count);
    port.addSource(&signalling);
    if (!listener_first) port.setListener(&count);
    CHECK(signalling.listener == &count);
    CHECK_FALSE(port.hasPolledSources());
    TestSource silent;
    port.addSource(&silent);
    CHECK(port.hasPolledSources());
    port.removeSource(&silent);
    CHECK_FALSE(port.hasPolledSources());
    port.removeSource(&signalling);
    CHECK(signalling.listener == nullptr);
}

TEST_CASE("a removed source is not used any more") {
    InputDataPort<double> port;
    TestSource source;
    port.addSource(&source);
    port.removeSource(&source);
    source.send(1);
    CHECK(port.getSize() == 0);
    CHECK(source.waiting.size() == 1);
}

TEST_CASE("reset drops the values that wait in the sources") {
    InputDataPort<double> port;
    TestSource source;
    port.addSource(&source);
    source.send(1);
    port.reset();
    CHECK(source.waiting.empty());
}

TEST_CASE("a port whose type cannot be archived refuses a source") {
    struct Local {
        int n = 0;
    };
    InputDataPort<Local> port;
    TestSource source;
    CHECK(port.addSource(&source) == OPROS_UNSUPPORTED_METHOD);
    CHECK(port.addSource(nullptr) == OPROS_BAD_INPUT_PARAMETER);
}

TEST_CASE("a value can be pushed from an archive") {
    InputDataPort<double> port;
    BinaryPipe pipe;
    pipe.out << 2.5;
    CHECK(static_cast<InputDataPortInterface&>(port).push(pipe.in) == OPROS_SUCCESS);
    CHECK(pop(port) == 2.5);
}

namespace {
/// Its reading throws something that is not a std::exception.
struct ThrowingOnLoad {
    void save(opros::archive::oarchive& ar, const unsigned int) { ar << number; }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        ar >> number;
        if (number == 0) throw 42;
    }
    int number = 1;
};
inline std::string typeName(ThrowingOnLoad*) { return "ThrowingOnLoad"; }
} // namespace

TEST_CASE("a value whose load() throws any type is dropped and the next value of its source is read") {
    class ThrowingSource : public TestSource {
      public:
        void send(int number) {
            BinaryPipe pipe;
            ThrowingOnLoad value;
            value.number = number;
            pipe.out << value;
            waiting.push_back(pipe.bytes.str());
        }
    } throwing_source;
    InputDataPort<ThrowingOnLoad> port;
    REQUIRE(port.addSource(&throwing_source) == OPROS_SUCCESS);
    for (int number : {0, 7}) throwing_source.send(number);
    const std::unique_ptr<opros_any> any(port.pop());
    REQUIRE(any);
    CHECK(port.getContent(*any).number == 7);
    CHECK(throwing_source.finished == 2);
    CHECK(throwing_source.error == "an exception of unknown type");
}

TEST_CASE(
    "a rehearsal of an input port reads the last value once more, for nobody, without an allocation except "
    "for decoding") {
    const std::vector<double> values{1, 2, 3};
    RepeatingSource source(values);
    InputDataPort<std::vector<double>> port;
    REQUIRE(port.addSource(&source) == OPROS_SUCCESS);
    const auto take = [&] {
        source.ready = true;
        const std::unique_ptr<opros_any> value(port.pop());
        return value && port.getContent(*value) == values;
    };
    for (int i = 0; i < 100; ++i) REQUIRE(take());
    std::thread([&] { port.rehearse(); }).join();
    CHECK(source.repeats == 0); // it is another thread that reads
    if (!tandem::test::mutexes_have_owners()) TANDEM_SKIP("membarrier(2) is not permitted");
    std::vector<double> decoded = values;
    source.ready = true;
    const long before = allocations();
    *source.next() >> decoded;
    const long between = allocations();
    source.done();
    port.rehearse();
    CHECK(allocations() - between == between - before);
    CHECK(source.repeats == 1);
    CHECK(port.pop() == nullptr);
    CHECK(take());
    for (int i = 0; i < 10'000; ++i) REQUIRE(port.pop() == nullptr);
    CHECK(source.repeats == 3); // every 4096th time
}
