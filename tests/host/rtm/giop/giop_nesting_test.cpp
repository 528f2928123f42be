// SPDX-License-Identifier: Apache-2.0
// Values and types that contain others many times over. omniORB 4.2 reads each `any` within another one twice, so that a request
// of 200 bytes takes a thread for years. omniORB 4.3 reads them by recursion, and both read a TypeCode so, until the stack ends.
// host/rtm/runtime/workarounds/omniorb_nesting.cpp prevents this.
#include "giop_client.hpp"
#include "tests/host/rtm/manager_fixture.hpp"

using namespace testing;

namespace {

void append_number(Bytes& to, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<unsigned char>(value >> shift));
}

/// An any that contains `levels - 1` others, the last of which contains nothing, in CDR (little-endian).
Bytes nested_any(int levels) {
    Bytes any;
    for (int i = 1; i < levels; ++i) append_number(any, CORBA::tk_any);
    append_number(any, CORBA::tk_null);
    return any;
}

/// An any with an empty sequence of sequences of ... of long.
Bytes any_with_nested_type(int levels) {
    // A TypeCode of a sequence is: kind, size of the encapsulation, byte order, TypeCode of the elements, bound.
    Bytes type;
    for (int i = levels; i > 0; --i) {
        append_number(type, CORBA::tk_sequence);
        append_number(type, static_cast<std::uint32_t>(4 + 16 * (i - 1) + 4 + 4));
        append_number(type, 1); // little-endian, and padding
    }
    append_number(type, CORBA::tk_long);
    for (int i = 0; i < levels; ++i) append_number(type, 0); // no bound
    append_number(type, 0);                                  // no elements
    return type;
}

class Host {
  public:
    Host() : host_("Accumulator") {
        REQUIRE(host_.host.wait_for_output("ready\n"));
        auto* orb = fixture_.manager().theORB();
        accumulator_ = host_.component(orb, "Accumulator0");
        configuration_ = accumulator_->get_configuration();
        SDOPackage::ConfigurationSet set;
        set.id = CORBA::string_dup("nested");
        set.description = CORBA::string_dup("");
        set.configuration_data.length(1);
        set.configuration_data[0].name = CORBA::string_dup("gain");
        set.configuration_data[0].value <<= CORBA::Long{1}; // the last 8 bytes of the request
        valid_ = call(object_key(orb, configuration_.in()), "add_configuration_set", set);
    }

    /// The status of the reply to add_configuration_set() with this any: 0 if the host carries it out, 2 for a system
    /// exception, and -1 if none comes.
    int reply_status(const Bytes& any) {
        Bytes arguments = first_part(valid_.arguments[1], valid_.arguments[1].size() - 8);
        arguments.insert(arguments.end(), any.begin(), any.end());
        Sockets sockets;
        const int fd = sockets.open(host_.port);
        REQUIRE(send_all(fd, request(valid_.key, valid_.operation, arguments, 2, true)));
        unsigned char answer[24] = {};
        return recv(fd, answer, sizeof answer, MSG_WAITALL) == 24 && answer[7] == 1 ? answer[16] : -1;
    }

  private:
    RemoteHost host_;
    ManagerFixture fixture_;
    RTC::RTObject_var accumulator_;
    SDOPackage::Configuration_var configuration_;
    Call valid_;
};

} // namespace

TEST_CASE("Values and types of moderate nesting are read, and deeply nested ones are refused") {
    Host host;
    CHECK(host.reply_status(nested_any(1)) == 0);
    CHECK(host.reply_status(nested_any(10)) == 0);
    const bool counts_anys = omniORB::versionHex() < 0x04030000;
    CHECK(host.reply_status(nested_any(11)) == (counts_anys ? 2 : 0));
    CHECK(host.reply_status(nested_any(60)) == (counts_anys ? 2 : 0));
    CHECK(host.reply_status(nested_any(10'000)) == 2);
    CHECK(host.reply_status(nested_any(1'000'000)) == 2);
    CHECK(host.reply_status(any_with_nested_type(32)) == 0);
    CHECK(host.reply_status(any_with_nested_type(33)) == 2);
    CHECK(host.reply_status(any_with_nested_type(60'000)) == 2);
    // What was refused has left nothing behind.
    CHECK(host.reply_status(nested_any(10)) == 0);
    CHECK(host.reply_status(any_with_nested_type(32)) == 0);
}
