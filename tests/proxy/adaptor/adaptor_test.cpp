// SPDX-License-Identifier: Apache-2.0
// Mirrored ports and calls in both directions, and the adaptor's own settings.
#include "chair_service.hpp"
#include "provided_port_connector.hpp"
#include "proxy/wire/time.hpp"
#include "scene.hpp"

#include <catch2/catch.hpp>

#include <IDataPortLink.h>
#include <InputDataPort.h>
#include <MethodInvokeException.h>
#include <OutputDataPort.h>

#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

using namespace tandem;
using namespace std::chrono_literals;
using adaptor::test::Peer;
using adaptor::test::Scene;
using link::CallStatus;
using link::PortKind;
using link::test::eventually;
using link::test::soon;

namespace {

/// A type that contains RTM's time, which the OPRoS side may have.
struct Stamped {
    unsigned int sec = 0, nsec = 0;
    std::vector<double> data;
    bool operator==(const Stamped&) const = default;
};
inline std::string typeName(Stamped*) { return "Stamped"; }
struct Time {
    Stamped* of;
};
inline std::string typeName(Time*) { return "Time"; }
inline void save_this(opros::archive::oarchive& ar, Time& time) { ar << time.of->sec << time.of->nsec; }
inline void load_this(opros::archive::iarchive& ar, Time& time) { ar >> time.of->sec >> time.of->nsec; }
inline void save_this(opros::archive::oarchive& ar, Stamped& value) {
    Time time{&value};
    ar << time << value.data;
}
inline void load_this(opros::archive::iarchive& ar, Stamped& value) {
    Time time{&value};
    ar >> time >> value.data;
}

class Chair : public IChair {
  public:
    std::vector<double> limits(int axis) override {
        if (axis > 9) throw std::runtime_error("no such axis");
        return {double(axis), 2};
    }
    std::string name() override { return "chair"; }
};

} // namespace

TEST_CASE("the adaptor creates a mirror of each port of the peer") {
    Scene scene("ports");
    CHECK(scene.component.getPort("linkState") != nullptr);
    CHECK(scene.port<OutputDataPortInterface>("reference").getRole() == OPROS_DATA_PORT_OUTPUT);
    CHECK(scene.port<InputDataPortInterface>("position").getRole() == OPROS_DATA_PORT_INPUT);
    CHECK(scene.port<ProvidedServicePort>("joystick").isDynamic());
    CHECK(scene.port<RequiredServicePort>("chair").isDynamic());
}

namespace {

/// Notes the values that an output port sends.
struct Recorder : IDataPortLink {
    ReturnType push(opros_any& value) override {
        const std::lock_guard lock(mutex);
        values.push_back(*opros_any_cast<std::vector<double>>(&value));
        return OPROS_SUCCESS;
    }
    std::vector<double> last() {
        const std::lock_guard lock(mutex);
        return values.empty() ? std::vector<double>() : values.back();
    }
    ReturnType setSource(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType addDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(DataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType removeDestination(RemoteDataPort*) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearDestination() override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType clearSource() override { return OPROS_UNSUPPORTED_METHOD; }

    std::mutex mutex;
    std::vector<std::vector<double>> values;
};

} // namespace

TEST_CASE("linkState sends the time, the number of the change, and whether the peer is there") {
    Recorder recorder;
    Scene scene("state");
    auto& port = scene.port<OutputDataPortInterface>("linkState");
    port.addConnection(&recorder);
    scene.peer.link.close();
    REQUIRE(eventually([&] { return !recorder.last().empty(); }));
    const auto gone = recorder.last();
    REQUIRE(gone.size() == 3);
    CHECK((gone[0] > 0 && gone[2] == 0));
    Peer again(scene.name);
    REQUIRE(eventually([&] { return recorder.last()[2] == 1; }));
    CHECK(recorder.last()[1] == gone[1] + 1);
    port.removeConnection(&recorder);
}

TEST_CASE("a value pushed to a mirrored input arrives without the time, which is in the header") {
    Scene scene("push");
    auto& position = scene.port<InputDataPortInterface>("position");
    opros_any sample{std::vector<double>()};
    REQUIRE(position.checkType(sample));
    opros_any value{std::vector<double>{1, 2, 3}};
    CHECK(position.push(value) == OPROS_SUCCESS);
    auto& reader = scene.peer.link.reader("position");
    REQUIRE(eventually([&] { return !reader.empty(); }));
    std::vector<double> got;
    reader.read(false, [&](const shm::Record& record) {
        wire::CdrReader in(record.bytes);
        for (auto left = in.get_count(8); left > 0; --left) got.push_back(in.get<double>());
        CHECK(record.stamp_ns != 0);
    });
    CHECK(got == std::vector<double>{1, 2, 3});
}

TEST_CASE("a rehearsal at a mirrored input sends nothing and counts nothing") {
    Scene scene("rehearsal");
    auto& position = scene.port<InputDataPortInterface>("position");
    const std::vector<double> numbers{1, 2, 3};
    opros_any_view::of<std::vector<double>> value(numbers);
    REQUIRE(position.checkType(value));
    REQUIRE(dynamic_cast<rt::Rehearsable*>(&position) != nullptr);
    const auto rehearse = [&] {
        const rt::Rehearsal rehearsal;
        position.push(value);
    };
    for (int i = 0; i < 50; ++i) {
        rehearse();
        REQUIRE(position.push(value) == OPROS_SUCCESS);
        rehearse();
    }
    const auto counters = scene.peer.link.reader("position").counters();
    CHECK(counters.sent == 50);
    CHECK(counters.dropped() + counters.waiting() == 50);
}

TEST_CASE("a connected input port reads the ring itself") {
    Scene scene("poll");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    InputDataPort<std::vector<double>> input;
    REQUIRE(reference.checkType(&input));
    CHECK(input.pop() == nullptr);
    for (int i = 1; i <= 3; ++i)
        REQUIRE(scene.peer.link.writer("reference").write(0, [&](wire::CdrWriter& out) {
            out.put<std::uint32_t>(1);
            out.put(double(i));
        }));
    for (int i = 1; i <= 3; ++i) {
        std::unique_ptr<opros_any> value(input.pop());
        REQUIRE(value);
        CHECK(input.getContent(*value) == std::vector<double>{double(i)});
    }
    CHECK(input.pop() == nullptr);
    reference.clearConnection();
}

TEST_CASE("the doorbell tells an event-driven consumer of messages, and nothing polls") {
    struct Count : DataPortListener {
        std::atomic<int> arrivals{0};
        void arrived() override { ++arrivals; }
    } count;
    Scene scene("listen");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    InputDataPort<std::vector<double>> input;
    input.setListener(&count);
    REQUIRE(reference.checkType(&input));
    CHECK_FALSE(input.hasPolledSources());
    REQUIRE(eventually([&] { return scene.peer.has_received(".listen"); }));
    auto& writer = scene.peer.link.writer("reference");
    for (int i = 1; i <= 3; ++i) {
        REQUIRE(writer.write(0, [&](wire::CdrWriter& out) {
            out.put<std::uint32_t>(1);
            out.put(double(i));
        }));
        REQUIRE(eventually([&] { return count.arrivals == i; }));
        std::unique_ptr<opros_any> value(input.pop());
        REQUIRE(value);
        CHECK(input.getContent(*value) == std::vector<double>{double(i)});
    }
    reference.clearConnection();
    REQUIRE(writer.write(0, [&](wire::CdrWriter& out) { out.put<std::uint32_t>(0); }));
    std::this_thread::sleep_for(20ms);
    CHECK(count.arrivals == 3);
}

TEST_CASE(
    "only the listener of a link's sole consumer may sleep on the doorbell, until another one listens") {
    struct Sleeper : DataPortListener {
        void arrived() override {}
        bool offerWaiter(ArrivalWaiter* offered) override {
            waiter = offered;
            return true;
        }
        void withdrawWaiter(ArrivalWaiter* withdrawn) override {
            if (waiter == withdrawn) waiter = nullptr;
        }
        std::atomic<ArrivalWaiter*> waiter{nullptr};
    } first, second;
    Scene scene("lent");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    InputDataPort<std::vector<double>> input, other;
    input.setListener(&first);
    other.setListener(&second);
    REQUIRE(reference.checkType(&input));
    REQUIRE(eventually([&] { return scene.peer.has_received(".listen"); }));
    ArrivalWaiter* const waiter = first.waiter;
    REQUIRE(waiter);
    auto& writer = scene.peer.link.writer("reference");
    const auto send = [&] {
        return writer.write(0, [](wire::CdrWriter& out) { out.put<std::uint32_t>(0); });
    };
    // The messages up to here may have been the notifier's.
    do {
        REQUIRE(send());
        waiter->wake(first);
    } while (waiter->wait(first) != ArrivalWaiter::ARRIVED);
    REQUIRE(send());
    CHECK(waiter->wait(first) == ArrivalWaiter::ARRIVED);
    waiter->wake(first);
    CHECK(waiter->wait(first) == ArrivalWaiter::WOKEN);

    REQUIRE(reference.checkType(&other));
    CHECK(first.waiter == nullptr);
    CHECK(second.waiter == nullptr);
    CHECK(waiter->wait(first) == ArrivalWaiter::REFUSED);
    other.setListener(nullptr);
    CHECK(first.waiter == waiter);
    reference.clearConnection();
    CHECK(first.waiter == nullptr);
}

TEST_CASE("the time of a value travels in the header and is back in the value afterwards") {
    Scene scene("stamped");
    auto& position = scene.port<InputDataPortInterface>("position");
    opros_any value{Stamped{1700000000, 999999999, {1, 2, 3}}};
    REQUIRE(position.checkType(value));
    REQUIRE(position.push(value) == OPROS_SUCCESS);
    auto& reader = scene.peer.link.reader("position");
    REQUIRE(eventually([&] { return !reader.empty(); }));
    auto& writer = scene.peer.link.writer("reference");
    reader.read(false, [&](const shm::Record& record) {
        CHECK(record.stamp_ns == wire::pack_time(1700000000, 999999999));
        CHECK(record.bytes.size() == 32); // count, padding, three doubles
        REQUIRE(writer.write_sized(record.bytes.size(), record.stamp_ns, [&](std::span<std::byte> room) {
            std::copy(record.bytes.begin(), record.bytes.end(), room.begin());
            return true;
        }));
    });
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    InputDataPort<Stamped> input;
    REQUIRE(reference.checkType(&input));
    std::unique_ptr<opros_any> back(input.pop());
    REQUIRE(back);
    CHECK(input.getContent(*back) == Stamped{1700000000, 999999999, {1, 2, 3}});
    reference.clearConnection();
}

TEST_CASE("64 MiB of doubles pass through the mirrored ports with and without the time") {
    Scene scene("large", "66000");
    auto& position = scene.port<InputDataPortInterface>("position");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    auto& reader = scene.peer.link.reader("position");
    auto& writer = scene.peer.link.writer("reference");
    const auto echo = [&] {
        REQUIRE(eventually([&] { return !reader.empty(); }));
        reader.read(false, [&](const shm::Record& record) {
            writer.write_sized(record.bytes.size(), record.stamp_ns, [&](std::span<std::byte> room) {
                std::copy(record.bytes.begin(), record.bytes.end(), room.begin());
                return true;
            });
        });
    };
    std::vector<double> cloud(8 * 1024 * 1024);
    for (std::size_t i = 0; i < cloud.size(); ++i) cloud[i] = static_cast<double>(i) / 3;
    const bool stamped = GENERATE(false, true);
    opros_any value = stamped ? opros_any(Stamped{7, 8, cloud}) : opros_any(cloud);
    REQUIRE(position.checkType(value));
    REQUIRE(position.push(value) == OPROS_SUCCESS);
    echo();
    if (stamped) {
        InputDataPort<Stamped> input;
        REQUIRE(reference.checkType(&input));
        std::unique_ptr<opros_any> back(input.pop());
        REQUIRE(back);
        CHECK((*input.getContentPointer(*back) == Stamped{7, 8, cloud}));
        reference.clearConnection();
    } else {
        InputDataPort<std::vector<double>> input;
        REQUIRE(reference.checkType(&input));
        std::unique_ptr<opros_any> back(input.pop());
        REQUIRE(back);
        CHECK((*input.getContentPointer(*back) == cloud));
        reference.clearConnection();
    }
}

TEST_CASE("mismatching types are refused at connection, with both signatures") {
    Scene scene("types");
    auto& reference = scene.port<OutputDataPortInterface>("reference");
    InputDataPort<int> wrong;
    CHECK_FALSE(reference.checkType(&wrong));
    CHECK_THAT(reference.typeError(), Catch::Contains("'i'") && Catch::Contains("'(uu)ad'"));
    auto& position = scene.port<InputDataPortInterface>("position");
    opros_any sample{std::string()};
    CHECK_FALSE(position.checkType(sample));
    CHECK_THAT(position.typeError(), Catch::Contains("'s'") && Catch::Contains("'(uu)ad'"));
}

TEST_CASE("a required port calls the peer, and learns why a call failed") {
    Scene scene("required");
    auto& joystick = scene.port<ProvidedServicePort>("joystick");
    ChairRequired required;
    ProvidedPortConnector connector(joystick);
    for (auto at = required.getFirst(); at != required.getEnd(); ++at) {
        REQUIRE(joystick.bindMethod(at->second) == "");
        dynamic_cast<RequiredMethodInterface&>(*at->second).Connect(&connector);
    }
    CHECK(required.limits(4) == std::vector<double>{6.0});
    scene.peer.refuse("limits");
    CHECK_THROWS_AS(required.limits(4), MethodInvokeException);
    try {
        required.limits(4);
    } catch (const MethodInvokeException& error) {
        CHECK_THAT(error.what(),
                   Catch::Contains("'joystick.limits'") && Catch::Contains("onActivated failed"));
    }
}

TEST_CASE("the peer calls what an OPRoS component provides, by signature") {
    Scene scene("provided");
    Chair chair;
    ChairProvided provided(&chair);
    REQUIRE(scene.port<RequiredServicePort>("chair").bindProvided(&provided) == "");
    std::vector<std::byte> arguments;
    wire::CdrWriter(arguments).put<std::int32_t>(3);
    auto& link = scene.peer.link;

    const auto reply = link.call({"chair", "limits", "i:ad", arguments}, soon);
    REQUIRE(reply.status == CallStatus::ok);
    wire::CdrReader results(reply.bytes);
    CHECK(results.get_count(8) == 2);
    CHECK(results.get<double>() == 3);

    CHECK(link.call({"chair", "limits", "d:ad", arguments}, soon).status == CallStatus::bad_arguments);
    CHECK(link.call({"chair", "limits", "i:ad", {}}, soon).status == CallStatus::bad_arguments);
    CHECK(link.call({"chair", "fly", ":", {}}, soon).status == CallStatus::no_such_operation);
    CHECK(link.call({"nobody", "fly", ":", {}}, soon).status == CallStatus::not_ready);
    wire::CdrWriter(arguments).put<std::int32_t>(10);
    const auto thrown = link.call({"chair", "limits", "i:ad", arguments}, soon);
    CHECK(thrown.status == CallStatus::exception);
    CHECK(thrown.text() == "no such axis");
    scene.port<RequiredServicePort>("chair").bindProvided(nullptr);
    const auto unbound = link.call({"chair", "limits", "i:ad", {}}, soon);
    CHECK(unbound.status == CallStatus::not_ready);
    CHECK_THAT(unbound.text(), Catch::StartsWith("not ready: "));
}

TEST_CASE("an adaptor without a link name, or with an invalid number, does not initialize") {
    adaptor::AdaptorComp nameless;
    CHECK(nameless.initialize() != OPROS_SUCCESS);
    CHECK_THROWS_WITH(adaptor::read_settings({{"link", "x"}, {"wait", "ten"}}),
                      "property 'wait' is 'ten': expected a number above 0 and below 1000000");
    CHECK_THROWS_WITH(adaptor::read_settings({{"link", "x"}, {"operations.books", "pages=Q:i"}}),
                      Catch::Contains("property 'operations.books': operation 'pages': "));
    CHECK_THROWS_WITH(adaptor::read_settings({{"link", "x"}, {"operations.books", "pages"}}),
                      Catch::Contains("OPERATION=ARGUMENTS:RESULT"));
    CHECK_THROWS_WITH(adaptor::read_settings({}), Catch::Contains("'link' is missing"));
}

TEST_CASE("a property gives the operations of a service if the peer has published none") {
    const auto settings =
        adaptor::read_settings({{"link", "x"}, {"operations.books", "pages=sad:ai, size=:i"}});
    link::Port port;
    port.kind = link::PortKind::service_provided;
    port.name = "books";
    const std::vector<link::ServiceOperation> given{{"pages", "sad:ai"}, {"size", ":i"}},
        told{{"size", ":x"}};
    CHECK(settings.with_operations(port).operations == given);
    port.operations = told;
    CHECK(settings.with_operations(port).operations == told);
    port.operations.clear();
    port.name = "shelf";
    CHECK(settings.with_operations(port).operations.empty());
}

TEST_CASE("the property 'group' of an adaptor is optional") {
    CHECK(adaptor::read_settings({{"link", "x"}}).group.empty());
    CHECK(adaptor::read_settings({{"link", "x"}, {"group", "robots"}}).group == "robots");
}

TEST_CASE("an adaptor whose peer never comes gives up after its waiting time") {
    adaptor::AdaptorComp lonely;
    lonely.setProperty("link", fmt::format("test-adaptor-lonely-{}", getpid()));
    lonely.setProperty("wait", "0.05");
    CHECK(lonely.initialize() != OPROS_SUCCESS);
}
