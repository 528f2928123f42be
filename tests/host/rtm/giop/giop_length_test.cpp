// SPDX-License-Identifier: Apache-2.0
// A false length within an `any`, in a request that is valid otherwise: omniORB 4.2 and 4.3 write beyond their buffer then,
// which host/rtm/runtime/workarounds/omniorb_bounds.cpp prevents.
#include "giop_message.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"

using namespace testing;

TEST_CASE(
    "A string in an any that claims to be longer than its message is refused and the host keeps running") {
    RemoteHost other("Accumulator");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTC::RTObject_var accumulator = other.component(orb, "Accumulator0");
    SDOPackage::Configuration_var configuration = accumulator->get_configuration();
    SDOPackage::ConfigurationSet set;
    set.id = CORBA::string_dup("late");
    set.description = CORBA::string_dup("");
    set.configuration_data.length(1);
    set.configuration_data[0].name = CORBA::string_dup("gain");
    const std::string text(99, 'x');
    set.configuration_data[0].value <<= text.c_str();
    const Call valid = call(object_key(orb, configuration.in()), "add_configuration_set", set);
    for (const std::uint32_t length : {100u, 101u, 0x7fffffffu, 0x80000000u, 0xffffffbcu, 0xffffffffu})
        for (const bool little : {false, true}) {
            CAPTURE(length, little);
            Bytes arguments = valid.arguments[little];
            const std::size_t at =
                arguments.size() - text.size() - 1 - 4; // the string is the last of the message
            for (std::size_t i = 0; i < 4; ++i)
                arguments[at + i] = static_cast<unsigned char>(length >> 8 * (little ? i : 3 - i));
            const int fd = connect_loopback(other.port);
            REQUIRE(fd >= 0);
            CHECK(send_all(fd, request(valid.key, valid.operation, arguments, 2, little)));
            unsigned char answer[24] = {};
            CHECK(recv(fd, answer, sizeof answer, MSG_WAITALL) == 24);
            CHECK(answer[7] == 1);                        // a reply ...
            CHECK(answer[16] == (length == 100 ? 0 : 2)); // ... to a valid request, or a system exception
            close(fd);
        }
    SDOPackage::ConfigurationSet_var kept = configuration->get_configuration_set("late");
    CHECK(kept->configuration_data.length() == 1);
}
