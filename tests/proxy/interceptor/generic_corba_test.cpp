// SPDX-License-Identifier: Apache-2.0
// The generic servant and the generic call against compiled stubs and skeletons, in one process and over a
// socket.
#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/signature_match.hpp"
#include "tests/proxy/interceptor/orb.hpp"

#include "Chair.hh"

#include <catch2/catch.hpp>

#include <functional>
#include <map>

using namespace tandem;
using interceptor::CallTarget;
using interceptor::generic_call;
using interceptor::GenericServant;
using interceptor::Orb;
using Status = interceptor::GenericCallResult::Status;

namespace {

const char* const seats_signature = "a(sn[3]db)s:a(sn[3]db)";

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
        if (speed > 2) throw TestChair::TooFast(speed);
    }
};

/// Hands every call on to a CORBA object by generic_call: servant and call in a row move each byte twice.
class Forward : public CallTarget {
  public:
    explicit Forward(CORBA::Object_ptr object) : object_(CORBA::Object::_duplicate(object)) {
        for (auto [name, signature] : {std::pair{"add", "di:d"},
                                       {"scale", "adf:ad"},
                                       {"rename", seats_signature},
                                       {"invert", "a[3]y:a[3]y"},
                                       {"drive", "d:"}}) {
            const auto operation = wire::parse_operation_signature(signature);
            operations_[name] = {wire::parse_signature(operation.arguments),
                                 wire::parse_signature(operation.result), signature};
        }
    }
    const Operation* find_operation(const char* name) override {
        const auto at = operations_.find(name);
        return at == operations_.end() ? nullptr : &at->second;
    }
    std::vector<std::byte> call(const char* name, const Operation& operation,
                                std::span<const std::byte> arguments) override {
        auto result = generic_call(object_, name, operation.arguments, operation.result, arguments,
                                   std::chrono::seconds(5));
        if (result.status != Status::ok) throw CORBA::UNKNOWN(0, CORBA::COMPLETED_MAYBE);
        return result.results;
    }

  private:
    CORBA::Object_var object_;
    std::map<std::string, Operation> operations_;
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

} // namespace

TEST_CASE("a generic servant and generic calls carry every type there and back") {
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
    SECTION("a user exception of the provider arrives as an exception") {
        TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
        CHECK_THROWS_AS(stub->drive(3), CORBA::UNKNOWN);
    }
}

TEST_CASE("a servant with a guessed repository id passes _narrow") {
    Orb orb;
    ChairServant chair;
    Active active_chair(orb, chair);
    Forward forward(active_chair.object);
    GenericServant servant("IDL:Guess:1.0", forward);
    Active active(orb, servant);
    TestChair::Chair_var stub = TestChair::Chair::_narrow(active.object);
    REQUIRE_FALSE(CORBA::is_nil(stub));
    check_chair(stub);
}

TEST_CASE("generic calls name what went wrong") {
    Orb orb;
    ChairServant chair;
    Active active(orb, chair);
    CORBA::Object_ptr object = active.object;
    const auto none = wire::parse_signature("");
    const auto d = wire::parse_signature("d");
    std::vector<std::byte> speed;
    wire::CdrWriter(speed).put(3.0);
    const auto second = std::chrono::seconds(1);

    const auto missing = generic_call(object, "fly", none, none, {}, second);
    CHECK(missing.status == Status::no_such_operation);
    CHECK_THAT(missing.text, Catch::Contains("'fly'"));
    const auto thrown = generic_call(object, "drive", d, none, speed, second);
    CHECK(thrown.status == Status::exception);
    CHECK_THAT(thrown.text, Catch::Contains("TooFast"));
    CHECK(generic_call(object, "drive", none, none, {}, second).status == Status::bad_arguments);
    CHECK(generic_call(object, "drive", d, none, {}, second).status == Status::bad_arguments);
    CHECK(generic_call(CORBA::Object::_nil(), "drive", d, none, speed, second).status == Status::unreachable);
}
