// SPDX-License-Identifier: Apache-2.0
// The reference to a provider while its port is connected and disconnected.
#include "proxy/interceptor/service/mirror_provided_port.hpp"
#include "proxy/interceptor/service/provider_reference.hpp"
#include "tests/proxy/interceptor/orb.hpp"

#include "Chair.hh"

#include <catch2/catch.hpp>

#include <atomic>
#include <thread>

using tandem::interceptor::MirrorProvidedPort;
using tandem::interceptor::Orb;
using tandem::interceptor::ProviderReference;
using tandem::link::CallStatus;

TEST_CASE("the reference that a caller has read from a provider stays valid after its release") {
    Orb orb;
    CORBA::Object_var object = orb.orb->resolve_initial_references("RootPOA");
    ProviderReference reference;
    CHECK(CORBA::is_nil(reference.getObject()));
    CHECK_FALSE(reference.setObject(CORBA::Object::_nil()));
    REQUIRE(reference.setObject(object));
    const CORBA::Object_ptr read = reference.getObject();
    reference.releaseObject();
    reference.releaseObject();
    CHECK(CORBA::is_nil(reference.getObject()));
    CHECK(read->_is_equivalent(object));
    REQUIRE(reference.setObject(object));
    CHECK(reference.getObject()->_is_equivalent(object));
}

TEST_CASE("threads call through a provider's reference while it is set and released") {
    Orb orb;
    CORBA::Object_var object = orb.orb->resolve_initial_references("RootPOA");
    ProviderReference reference;
    std::atomic<bool> stop{false};
    std::atomic<long> seen{0};
    std::thread caller([&] {
        while (!stop) {
            const CORBA::Object_ptr now = reference.getObject();
            if (!CORBA::is_nil(now) && now->_is_equivalent(object)) ++seen;
        }
    });
    long changes = 0;
    for (; changes < 1000 || (seen == 0 && changes < 1'000'000); ++changes) {
        reference.setObject(object);
        reference.releaseObject();
    }
    reference.setObject(object);
    while (seen == 0) std::this_thread::yield();
    stop = true;
    caller.join();
    CHECK(seen > 0);
}

TEST_CASE("a call of a port that was left out fails with the reason, until the port is connected") {
    MirrorProvidedPort mirror(
        {tandem::link::PortKind::service_provided, "arm", "Arm", "", "arm", {{"stop", ":"}}},
        std::chrono::seconds(1));
    const auto status_of = [&](std::string& text) {
        const auto reply = mirror.serve({"arm", "stop", ":", {}});
        text = reply.text();
        return reply.status;
    };
    std::string text;
    CHECK(status_of(text) == CallStatus::not_ready);
    mirror.leave_out("port 'arm' cannot be connected with that of Arm0: BAD_PARAMETER");
    CHECK(status_of(text) == CallStatus::no_such_operation);
    CHECK(text == "port 'arm' cannot be connected with that of Arm0: BAD_PARAMETER");
    mirror.leave_out("");
    CHECK(status_of(text) == CallStatus::not_ready);
}
