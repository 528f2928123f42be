// SPDX-License-Identifier: Apache-2.0
// The generic servant and the generic call against compiled stubs and skeletons, in one process and over a
// socket.
#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/interceptor/corba/generic_user_exception.hpp"
#include "proxy/interceptor/service/interface_operations.hpp"
#include "proxy/wire/cdr.hpp"
#include "tests/proxy/interceptor/orb.hpp"

#include "Chair.hh"

#include <catch2/catch.hpp>

#include <atomic>
#include <map>
#include <thread>
#include <vector>

using namespace tandem;
using interceptor::CallTarget;
using interceptor::generic_call;
using interceptor::GenericServant;
using interceptor::Orb;
using Status = interceptor::GenericCallFailure::Status;

namespace {

const char* const seats_signature = "a(sn[3]db)s:a(sn[3]db)";
const char* const drive_signature =
    "d: raises IDL:TestChair/TooFast:1.0({speed}d{occupied}a(sn[3]db)) IDL:TestChair/Broken:1.0()";

class ChairServant : public POA_TestChair::Chair {
    CORBA::Double add(CORBA::Double a, CORBA::Long b) override { return a + b; }
    TestChair::Doubles* scale(const TestChair::Doubles& values, CORBA::Float factor) override {
        auto* scaled = new TestChair::Doubles(values);
        for (CORBA::ULong i = 0; i < scaled->length(); ++i) (*scaled)[i] *= factor;
        return scaled;
    }
    TestChair::Seats* rename(const TestChair::Seats& seats, const char* name) override {
        auto* renamed = new TestChair::Seats(seats);
        for (CORBA::ULong i = 0; i < renamed->length(); ++i) (*renamed)[i].name = name;
        return renamed;
    }
    TestChair::Colors* invert(const TestChair::Colors& colors) override {
        auto* inverted = new TestChair::Colors(colors);
        for (CORBA::ULong i = 0; i < inverted->length(); ++i)
            for (int k = 0; k < 3; ++k) (*inverted)[i][k] = static_cast<CORBA::Octet>(255 - colors[i][k]);
        return inverted;
    }
    void drive(CORBA::Double speed) override {
        if (speed < 0) throw TestChair::Broken();
        if (speed > 9) throw CORBA::NO_PERMISSION(0, CORBA::COMPLETED_NO);
        if (speed <= 2) return;
        TestChair::Seats occupied;
        occupied.length(1);
        occupied[0].name = "front";
        occupied[0].legs = 3;
        occupied[0].used = true;
        throw TestChair::TooFast(speed, occupied);
    }
    void hide() override { throw TestChair::Hidden(7); }
    CORBA::Boolean locate(CORBA::Long row, TestChair::Seat_out found, TestChair::Doubles& trace,
                          CORBA::String_out text) override {
        found = new TestChair::Seat;
        found->name = "found";
        found->legs = static_cast<CORBA::Short>(row);
        found->used = true;
        trace.length(trace.length() + 1);
        trace[trace.length() - 1] = row;
        text = CORBA::string_dup("here");
        return row > 0;
    }
    TestChair::Furniture_ptr neighbour(TestChair::Furniture_ptr of, CORBA::Object_out none) override {
        none = CORBA::Object::_nil();
        return TestChair::Furniture::_duplicate(of);
    }
    void beep(CORBA::Long times) override { beeps += times; }
    char* owner() override { return CORBA::string_dup("Tandem"); }
    CORBA::Long number() override { return number_; }
    void number(CORBA::Long value) override { number_ = value; }

  public:
    std::atomic<int> beeps{0};

  private:
    CORBA::Long number_ = 4;
};

/// Passes every call on to a CORBA object by generic_call, so the servant and the call convert each value twice.
class Forward : public CallTarget {
  public:
    explicit Forward(CORBA::Object_ptr object) : object_(CORBA::Object::_duplicate(object)) {
        for (auto [name, signature] : {std::pair{"add", "di:d"},
                                       {"scale", "adf:ad"},
                                       {"rename", seats_signature},
                                       {"invert", "a[3]y:a[3]y"},
                                       {"drive", drive_signature},
                                       {"hide", ":"}, // as an IDL that does not declare the exception
                                       {"locate", "i>(sn[3]db)&ad>s:b"},
                                       {"beep", "i: oneway"},
                                       {"neighbour", "o>o:o"},
                                       {"_get_owner", ":s"},
                                       {"_get_number", ":i"},
                                       {"_set_number", "i:"}})
            operations_[name] = wire::parse_operation(signature);
    }
    const wire::Operation* find_operation(const char* name) override {
        const auto at = operations_.find(name);
        return at == operations_.end() ? nullptr : &at->second;
    }
    std::span<const std::byte> call(const char* name, const wire::Operation& operation,
                                    std::span<const std::byte> arguments,
                                    wire::MessageBuffer& memory) override {
        std::optional<interceptor::GenericCallFailure> failure;
        if (const auto results =
                generic_call(object_, name, operation, arguments, std::chrono::seconds(5), memory, failure))
            return *results;
        if (const auto* declared = operation.find_exception(failure->exception_id))
            throw interceptor::GenericUserException(*declared,
                                                    {failure->fields.begin(), failure->fields.end()});
        throw CORBA::UNKNOWN(0, CORBA::COMPLETED_MAYBE);
    }

  private:
    CORBA::Object_var object_;
    std::map<std::string, wire::Operation> operations_;
};

/// A servant while it is reachable.
struct Active {
    Active(Orb& orb, PortableServer::ServantBase& servant)
        : poa(orb.poa), id(poa->activate_object(&servant)) {
        object = poa->id_to_reference(id);
    }
    ~Active() { poa->deactivate_object(id); }
    PortableServer::POA_ptr poa;
    PortableServer::ObjectId_var id;
    CORBA::Object_var object;
};

void check_chair(TestChair::Chair_ptr chair) {
    CHECK(chair->add(1.5, 2) == 3.5);
    TestChair::Doubles values;
    values.length(3);
    values[0] = 1, values[1] = -2, values[2] = 4;
    TestChair::Doubles_var scaled = chair->scale(values, 0.5f);
    REQUIRE(scaled->length() == 3);
    CHECK((scaled[0] == 0.5 && scaled[1] == -1.0 && scaled[2] == 2.0));
    TestChair::Seats seats;
    seats.length(2);
    seats[0].used = seats[1].used = true;
    seats[1].legs = -4, seats[1].height[2] = 0.7, seats[1].used = true;
    TestChair::Seats_var renamed = chair->rename(seats, "driver");
    REQUIRE(renamed->length() == 2);
    CHECK(std::string(renamed[1].name) == "driver");
    CHECK((renamed[1].legs == -4 && renamed[1].height[2] == 0.7 && renamed[1].used));
    // Elements of three bytes: less than a count would take.
    TestChair::Colors colors;
    colors.length(2);
    for (CORBA::ULong i = 0; i < 3; ++i) colors[0][i] = 0, colors[1][i] = static_cast<CORBA::Octet>(i);
    TestChair::Colors_var inverted = chair->invert(colors);
    REQUIRE(inverted->length() == 2);
    CHECK((inverted[0][2] == 255 && inverted[1][0] == 255 && inverted[1][2] == 253));
    values.length(0);
    CHECK(TestChair::Doubles_var(chair->scale(values, 1.f))->length() == 0);
    CHECK_NOTHROW(chair->drive(1));
}

void check_out_arguments(TestChair::Chair_ptr chair) {
    TestChair::Seat_var found;
    TestChair::Doubles trace;
    trace.length(1);
    trace[0] = 0.25;
    CORBA::String_var text;
    CHECK(chair->locate(5, found, trace, text));
    CHECK((std::string(found->name) == "found" && found->legs == 5 && found->used));
    REQUIRE(trace.length() == 2);
    CHECK((trace[0] == 0.25 && trace[1] == 5));
    CHECK(std::string(text) == "here");
}

void check_exceptions(TestChair::Chair_ptr chair) {
    CHECK_THROWS_AS(chair->drive(-1), TestChair::Broken);
    CHECK_THROWS_AS(chair->hide(), CORBA::UNKNOWN);
    CHECK_THROWS_AS(chair->drive(10), CORBA::UNKNOWN); // Forward's; a system exception
    try {
        chair->drive(3);
        FAIL("no exception");
    } catch (const TestChair::TooFast& error) {
        CHECK(error.speed == 3);
        REQUIRE(error.occupied.length() == 1);
        CHECK((std::string(error.occupied[0].name) == "front" && error.occupied[0].legs == 3));
    }
}

void check_attributes(TestChair::Chair_ptr chair) {
    CHECK(std::string(CORBA::String_var(chair->owner())) == "Tandem");
    chair->number(12);
    CHECK(chair->number() == 12);
}

} // namespace

TEST_CASE("a generic servant and generic calls carry every type in both directions") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    Forward forward(active_chair.object);
    GenericServant servant("IDL:TestChair/Chair:1.0", forward);
    Active active(orb, servant);

    SECTION("with the repository id known") {
        TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
        REQUIRE_FALSE(CORBA::is_nil(stub));
        check_chair(stub);
    }
    SECTION("inherited attributes, out and inout arguments, exceptions with their members") {
        TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
        check_attributes(stub);
        check_out_arguments(stub);
        check_exceptions(stub);
    }
    SECTION("object references come back unchanged") {
        TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
        CORBA::Object_var none = CORBA::Object::_duplicate(stub);
        TestChair::Furniture_var back = stub->neighbour(stub, none.out());
        CHECK(back->_is_equivalent(stub));
        CHECK(std::string(CORBA::String_var(back->owner())) == "Tandem");
        CHECK(CORBA::is_nil(none));
    }
    SECTION("a oneway operation") {
        TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
        stub->beep(3);
        CHECK(chair.beeps == 3);
    }
}

TEST_CASE("a generic servant whose target is not ready does not exist for clients that ask") {
    struct : CallTarget {
        bool ready = false;
        std::string unknown;
        void unknown_operation(const char* name) override { unknown += name; }
        const wire::Operation* find_operation(const char*) override { return nullptr; }
        std::span<const std::byte> call(const char*, const wire::Operation&, std::span<const std::byte>,
                                        wire::MessageBuffer&) override {
            return {};
        }
        bool is_ready() const override { return ready; }
    } target;
    Orb orb;
    GenericServant servant("IDL:TestChair/Chair:1.0", target);
    Active active(orb, servant);
    CHECK(active.object->_non_existent());
    target.ready = true;
    CHECK_FALSE(active.object->_non_existent());
    TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
    CHECK(target.unknown.empty()); // though the ORB has asked for _is_a and _non_existent
    CHECK_THROWS_AS(stub->beep(1), CORBA::BAD_OPERATION);
    CHECK(target.unknown == "beep");
}

TEST_CASE("a servant confirms its interface and its bases, and no others") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    Forward forward(active_chair.object);
    GenericServant servant("IDL:TestChair/Chair:1.0", forward);
    Active active(orb, servant);
    for (const char* id :
         {"IDL:TestChair/Chair:1.0", "IDL:TestChair/Furniture:1.0", "IDL:omg.org/CORBA/Object:1.0"})
        CHECK(active.object->_is_a(id));
    for (const char* id :
         {"IDL:TestChair/Table:1.0", "IDL:openrtm.aist.go.jp/OpenRTM/DataFlowComponent:1.0", ""})
        CHECK_FALSE(active.object->_is_a(id));
    CHECK(CORBA::is_nil(TestChair::Table::_narrow(active.object)));
}

TEST_CASE(
    "a servant with a guessed repository id passes _narrow to the interface that its target knows by name") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    struct NamedForward : Forward {
        using Forward::Forward;
        bool may_be(const char* id) const override { return interceptor::is_named(id, "Chair"); }
    } forward(active_chair.object);
    GenericServant servant("IDL:Guess:1.0", forward);
    Active active(orb, servant);
    CHECK_FALSE(active.object->_is_a("IDL:TestChair/Armchair:1.0"));
    TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
    REQUIRE_FALSE(CORBA::is_nil(stub));
    check_chair(stub);
}

TEST_CASE("references of this process follow objects that are deactivated and activated again") {
    Orb orb;
    ChairServant chair;
    const PortableServer::ObjectId_var chair_id = orb.poa->activate_object(&chair);
    Forward forward(CORBA::Object_var(orb.poa->id_to_reference(chair_id)));
    GenericServant servant("IDL:TestChair/Chair:1.0", forward);
    const PortableServer::ObjectId_var id = orb.poa->activate_object(&servant);
    TestChair::Chair_var stub =
        TestChair::Chair::_narrow(CORBA::Object_var(orb.poa->id_to_reference(id)).in());
    const auto check_calls = [&] {
        // The first call goes through the ORB, the others directly.
        for (int i = 0; i < 3; ++i) CHECK(stub->add(1.5, i) == 1.5 + i);
        CHECK_FALSE(stub->_non_existent());
        CHECK(PortableServer::ServantBase_var(orb.poa->reference_to_servant(stub)).in() == &servant);
        CHECK(stub->add(2, 2) == 4);
    };
    check_calls();

    orb.poa->deactivate_object(id);
    for (int i = 0; i < 2; ++i) CHECK_THROWS_AS(stub->add(1, 1), CORBA::OBJECT_NOT_EXIST);
    orb.poa->activate_object_with_id(id, &servant);
    check_calls();

    orb.poa->deactivate_object(chair_id);
    for (int i = 0; i < 2; ++i) CHECK_THROWS_AS(stub->add(1, 1), CORBA::UNKNOWN); // what Forward throws
    orb.poa->activate_object_with_id(chair_id, &chair);
    check_calls();
    orb.poa->deactivate_object(id);
    orb.poa->deactivate_object(chair_id);
}

TEST_CASE("calls through a reference while its object comes and goes either run or are refused") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    Forward forward(active_chair.object);
    GenericServant servant("IDL:TestChair/Chair:1.0", forward);
    const PortableServer::ObjectId_var id = orb.poa->activate_object(&servant);
    TestChair::Chair_var stub =
        TestChair::Chair::_narrow(CORBA::Object_var(orb.poa->id_to_reference(id)).in());
    std::atomic<int> wrong{0}, made{0};
    std::atomic<bool> ends{false};
    std::vector<std::thread> callers;
    for (int i = 0; i < 3; ++i)
        callers.emplace_back([&] {
            const omni_thread::ensure_self known;
            while (!ends) {
                try {
                    if (stub->add(1, 2) != 3) ++wrong;
                    ++made;
                } catch (const CORBA::OBJECT_NOT_EXIST&) { // refused
                }
            }
        });
    for (int i = 0; i < 100; ++i) {
        for (const int before = made; made < before + 10;) std::this_thread::yield();
        orb.poa->deactivate_object(id);
        orb.poa->activate_object_with_id(id, &servant);
    }
    ends = true;
    for (auto& caller : callers) caller.join();
    CHECK(wrong == 0);
    orb.poa->deactivate_object(id);
}

TEST_CASE("arguments and results within the process may have any length") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    Forward forward(active_chair.object);
    GenericServant servant("IDL:TestChair/Chair:1.0", forward);
    Active active(orb, servant);
    TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
    for (const CORBA::ULong count : {0U, 1U, 7U, 8U, 9U, 60U, 100U, 20000U}) {
        TestChair::Doubles values;
        values.length(count);
        for (CORBA::ULong i = 0; i < count; ++i) values[i] = i;
        TestChair::Doubles_var scaled = stub->scale(values, 2);
        REQUIRE(scaled->length() == count);
        for (CORBA::ULong i = 0; i < count; ++i) REQUIRE(scaled[i] == 2. * i);
    }
}

TEST_CASE("generic calls report what went wrong") {
    Orb orb;
    ChairServant chair;
    Active active(orb, chair);
    CORBA::Object_ptr object = active.object;
    const auto none = wire::parse_operation(":");
    const auto drive = wire::parse_operation(drive_signature);
    wire::MessageBuffer memory; // of the last results
    const auto fail = [&](CORBA::Object_ptr of, const char* name, const wire::Operation& as,
                          const std::vector<std::byte>& argument) {
        std::optional<interceptor::GenericCallFailure> failure;
        CHECK_FALSE(generic_call(of, name, as, argument, std::chrono::seconds(1), memory, failure));
        REQUIRE(failure);
        return *failure;
    };
    const auto call = [&](CORBA::Object_ptr of, const char* name, const wire::Operation& as, double speed) {
        std::vector<std::byte> argument;
        wire::CdrWriter(argument).put(speed);
        return fail(of, name, as, argument);
    };
    const auto missing = call(object, "fly", none, 0);
    CHECK(missing.status == Status::no_such_operation);
    CHECK_THAT(missing.text, Catch::Contains("'fly'"));

    const auto thrown = call(object, "drive", drive, 3.0);
    CHECK(thrown.status == Status::exception);
    CHECK(thrown.exception_id == "IDL:TestChair/TooFast:1.0");
    CHECK_THAT(thrown.text, Catch::Contains("TooFast"));
    CHECK(wire::CdrReader(thrown.fields).get<double>() == 3.0);
    const auto undeclared = call(object, "drive", wire::parse_operation("d:"), 3.0);
    CHECK(undeclared.status == Status::exception);
    CHECK(undeclared.exception_id == "IDL:TestChair/TooFast:1.0");
    CHECK(undeclared.fields.empty());
    const auto system = call(object, "drive", drive, 10);
    CHECK(system.status == Status::exception);
    CHECK(system.exception_id == "IDL:omg.org/CORBA/NO_PERMISSION:1.0");

    CHECK(call(object, "drive", none, 0).status == Status::bad_arguments);
    // A text that is not a reference, and one that would make the ORB ask another host.
    for (const char* text : {"IOR:00zz", "corbaloc::127.0.0.1:1/Nobody", "IOR:"}) {
        std::vector<std::byte> argument;
        wire::CdrWriter(argument).put_string(text);
        const auto refused = fail(object, "neighbour", wire::parse_operation("o>o:o"), argument);
        CHECK((refused.status == Status::bad_arguments || refused.status == Status::exception));
    }
    CHECK(fail(object, "drive", drive, {}).status == Status::bad_arguments);
    CHECK(call(CORBA::Object::_nil(), "drive", drive, 1).status == Status::unreachable);
}
