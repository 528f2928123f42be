// SPDX-License-Identifier: Apache-2.0
// Calls that the ORB's stubs accept and that cannot be made.
#include "proxy/interceptor/corba/generic_servant.hpp"
#include "proxy/interceptor/service/mirror_required_port.hpp"
#include "tests/proxy/interceptor/orb.hpp"
#include "tests/proxy/link/link_side.hpp"

#include "Chair.hh"

#include <catch2/catch.hpp>

#include <string>

using namespace tandem;
using interceptor::CallTarget;
using interceptor::GenericServant;
using interceptor::Orb;

TEST_CASE("a caller whose values cannot cross learns whether the call has run, and the target why") {
    struct Damaged : CallTarget {
        const wire::Operation operation = wire::parse_operation("di:d"),
                              rename = wire::parse_operation("e#1:");
        int calls = 0;
        std::string refused;
        const wire::Operation* find_operation(const char* name) override {
            return name == std::string("add")      ? &operation
                   : name == std::string("rename") ? &rename
                                                   : nullptr;
        }
        std::span<const std::byte> call(const char*, const wire::Operation&, std::span<const std::byte>,
                                        wire::MessageBuffer& memory) override {
            ++calls;
            return memory.room_for(3);
        }
        void value_refused(const char* name, const char* what, const std::string& reason) override {
            refused += std::string(name) + ": " + what + ": " + reason + "; ";
        }
    } target;
    Orb orb;
    GenericServant servant("IDL:TestChair/Chair:1.0", target);
    const PortableServer::ObjectId_var id = orb.poa->activate_object(&servant);
    const CORBA::Object_var object = orb.poa->id_to_reference(id);
    TestChair::Chair_var stub = TestChair::Chair::_narrow(object);
    const auto completed_by = [](const auto& call) {
        try {
            call();
        } catch (const CORBA::MARSHAL& error) {
            return error.completed();
        }
        return CORBA::COMPLETED_MAYBE;
    };
    // The first call goes through the ORB, the second one directly.
    for (int i = 1; i <= 2; ++i) {
        CHECK(completed_by([&] { stub->add(1, 2); }) == CORBA::COMPLETED_YES);
        CHECK(target.calls == i);
    }
    CHECK(target.refused == "add: its result: MARSHAL; add: its result: MARSHAL; ");
    target.refused.clear();
    TestChair::Seats seats; // begins with their number
    seats.length(2);
    for (int i = 0; i < 2; ++i)
        CHECK(completed_by([&] { TestChair::Seats_var(stub->rename(seats, "x")); }) == CORBA::COMPLETED_NO);
    CHECK(target.calls == 2);
    CHECK_THAT(target.refused,
               Catch::Contains("rename: an argument: 2 is not a value of an enumeration of 1"));
    orb.poa->deactivate_object(id);
}

TEST_CASE(
    "a call of an operation that a component lacks raises BAD_OPERATION, or TRANSIENT while its operations "
    "are unknown") {
    Orb orb;
    link::test::LinkSide side{shm::Side::second, {.name = link::test::unique_name("unknown")}, {}};
    const auto call_hide = [&](std::vector<link::ServiceOperation> operations) {
        interceptor::MirrorRequiredPort mirror({link::PortKind::service_required, "Tally.chair",
                                                "TestChair::Chair", "", "chair", std::move(operations)},
                                               side.link, std::chrono::seconds(1));
        const PortableServer::ObjectId_var id = orb.poa->activate_object(&mirror.servant());
        const CORBA::Object_var object = orb.poa->id_to_reference(id);
        CHECK(object->_is_a("IDL:TestChair/Furniture:1.0"));
        CHECK_FALSE(object->_is_a("IDL:TestChair/Table:1.0"));
        TestChair::Chair_var stub = TestChair::Chair::_narrow(object);
        std::string thrown;
        try {
            stub->hide();
        } catch (const CORBA::SystemException& error) {
            thrown = error._name();
        }
        orb.poa->deactivate_object(id);
        return thrown;
    };
    CHECK(call_hide({{"add", "di:d"}}) == "BAD_OPERATION");
    CHECK(call_hide({}) == "TRANSIENT");
}
