// SPDX-License-Identifier: Apache-2.0
// The interface type shared_memory: the object with the message, and peers that answer as OpenRTM-aist's do.
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/transport/shared_memory/shared_message.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <coil/UUID.h>
#include <fcntl.h>
#include <filesystem>
#include <rtm/CORBA_RTCUtil.h>
#include <sys/mman.h>

using namespace testing;
using RTC::SharedMessageReader;
using RTC::SharedMessageWriter;

namespace {

RTC::ByteData bytes_of(const std::string& text, bool little_endian) {
    RTC::ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(reinterpret_cast<const unsigned char*>(text.data()), text.size());
    return bytes;
}
std::string text_of(const RTC::ByteData& bytes) {
    return {reinterpret_cast<const char*>(bytes.getBuffer()), bytes.getDataLength()};
}
bool exists(const std::string& name) { return std::filesystem::exists("/dev/shm/" + name); }

/// An object of which the test writes every byte.
struct RawObject {
    explicit RawObject(const std::string& content, std::string object_name = new_name())
        : name(std::move(object_name)) {
        const int descriptor = shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
        REQUIRE(write(descriptor, content.data(), content.size()) == static_cast<ssize_t>(content.size()));
        close(descriptor);
    }
    ~RawObject() { shm_unlink(name.c_str()); }
    static std::string new_name() { return coil::UUID_Generator().generateUUID()->to_string(); }
    std::string name;
};

} // namespace

TEST_CASE("A message goes through a shared memory object in either byte order, and the object grows") {
    const bool little_endian = GENERATE(true, false);
    SharedMessageWriter writer;
    SharedMessageReader reader;
    CHECK_FALSE(writer.write(bytes_of("no object yet", little_endian)));
    REQUIRE(writer.create(10));
    REQUIRE(reader.open(writer.name()));
    RTC::ByteData received;
    for (const std::string& text : {std::string("one"), std::string(), std::string(2000000, 'x')}) {
        REQUIRE(writer.write(bytes_of(text, little_endian)));
        REQUIRE(reader.read(received, little_endian));
        CHECK(text_of(received) == text);
    }
    const std::string large(5000000, 'y');
    CHECK_FALSE(writer.fits(large.size()));
    CHECK_FALSE(writer.write(bytes_of(large, little_endian)));
    const std::string small_object = writer.name();
    REQUIRE(writer.create(large.size()));
    CHECK_FALSE(exists(small_object));
    REQUIRE(reader.open(writer.name()));
    REQUIRE(writer.write(bytes_of(large, little_endian)));
    REQUIRE(reader.read(received, little_endian));
    CHECK(text_of(received) == large);
    writer.remove();
    CHECK_FALSE(exists(writer.name()));
}

TEST_CASE("A shared memory object that a peer has broken is refused") {
    RTC::ByteData received;
    for (const std::string& content :
         {std::string(), std::string("short"), std::string("\x05\0\0\0\0\0\0\0four", 12),
          std::string("\xff\xff\xff\xff\xff\xff\xff\xff....", 12)}) {
        RawObject object(content);
        SharedMessageReader reader;
        REQUIRE(reader.open(object.name));
        CHECK_FALSE(reader.read(received, true));
    }
    RawObject object(std::string("\x04\0\0\0\0\0\0\0four", 12));
    SharedMessageReader reader;
    REQUIRE(reader.open(object.name));
    REQUIRE(reader.read(received, true));
    CHECK(text_of(received) == "four");
    CHECK_FALSE(reader.read(received, false)); // the length in the other byte order
    // Truncated while it is open: an error, not a signal.
    REQUIRE(truncate(("/dev/shm/" + object.name).c_str(), 10) == 0);
    CHECK_FALSE(reader.read(received, true));
}

TEST_CASE("Only objects that are named like OpenRTM-aist's are opened and removed") {
    RawObject foreign("data of another program", "test-" + std::to_string(getpid()));
    SharedMessageReader reader;
    for (const std::string& name :
         {foreign.name, std::string(), std::string("/"), std::string("../etc/passwd"), std::string(36, 'g'),
          std::string(37, 'a'), RawObject::new_name()})
        CHECK_FALSE(reader.open(name));
    reader.remove_name();
    CHECK(exists(foreign.name));
}

TEST_CASE(
    "shared_memory with a port of another machine is refused in one line, in both directions and flows") {
    ManagerFixture fixture;
    auto& counter = fixture.create<Counter>("Counter");
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    // 192.0.2.0/24 is the network of examples (RFC 5737): nobody has such an address, and no call is made.
    CORBA::Object_var object =
        fixture.manager().theORB()->string_to_object("corbaloc:iiop:192.0.2.1:2810/port");
    RTC::PortService_var elsewhere = RTC::PortService::_unchecked_narrow(object.in());
    for (const char* flow : {"push", "pull"})
        for (RTC::PortBase* port : std::vector<RTC::PortBase*>{&counter.out_, &accumulator.in_}) {
            CAPTURE(flow, port->getName());
            RTC::PortService_var here = port->getPortRef();
            coil::Properties properties;
            properties.setProperty("dataport.interface_type", "shared_memory");
            properties.setProperty("dataport.dataflow_type", flow);
            RTC::ConnectorProfile_var profile =
                CORBA_RTCUtil::create_connector("shm", properties, here.in(), elsewhere.in());
            CHECK(port->notify_connect(profile.inout()) == RTC::BAD_PARAMETER);
            CHECK(port->connectError() == std::string(port->getName()) +
                                              ": interface_type is shared_memory, for ports of one machine, "
                                              "but a port of the connection is at "
                                              "giop:tcp:192.0.2.1:2810; use corba_cdr");
            CHECK(connection_count(*port) == 0);
        }
}

TEST_CASE("The addresses of this machine are distinguished from those of others") {
    ManagerFixture fixture;
    auto address_of = [&](const std::string& host) {
        CORBA::Object_var object =
            fixture.manager().theORB()->string_to_object(("corbaloc:iiop:" + host + ":2810/x").c_str());
        return RTC::address_on_another_machine(object.in());
    };
    CHECK(address_of("127.0.0.1").empty());
    CHECK(address_of("127.1.2.3").empty());
    CHECK(address_of("localhost").empty());
    CHECK(address_of("[::1]").empty());
    CHECK(address_of("192.0.2.1") == "giop:tcp:192.0.2.1:2810");
    CHECK(address_of("[2001:db8::1]") == "giop:tcp:[2001:db8::1]:2810"); // RFC 3849: for examples
    // Of several addresses, as of a machine with several networks, one is enough.
    CORBA::Object_var two =
        fixture.manager().theORB()->string_to_object("corbaloc:iiop:192.0.2.1:2810,iiop:127.0.0.1:2810/x");
    CHECK(RTC::address_on_another_machine(two.in()).empty());
    CHECK(RTC::address_on_another_machine(CORBA::Object::_nil()).empty());
}

TEST_CASE("shared_memory drops the connection when the receiver dies and leaves no object behind") {
    // Names of the objects that this process has open; other tests have some of their own.
    auto open_objects = [] {
        std::vector<std::string> names;
        for (const auto& link : std::filesystem::directory_iterator("/proc/self/fd")) {
            std::error_code closed_meanwhile;
            const auto target = std::filesystem::read_symlink(link.path(), closed_meanwhile);
            if (target.parent_path() == "/dev/shm") names.push_back(target.filename().string());
        }
        return names;
    };
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:200", "manager.peer_check_interval:0.05"});
    auto& counter = fixture.create<Counter>("Counter");
    RemoteHost other("Reporter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    RTC::RTObject_var here = counter.getObjRef();
    RTC::RTObject_var there = other.component(fixture.manager().theORB(), "Reporter0");
    coil::Properties properties;
    properties.setProperty("dataport.interface_type", "shared_memory");
    properties.setProperty("dataport.buffer.write.full_policy", "do_nothing"); // else through a ring
    REQUIRE(CORBA_RTCUtil::connect_by_name("shm", properties, here.in(), "out", there.in(), "in") ==
            RTC::RTC_OK);
    CORBA_RTCUtil::activate(there.in());
    CORBA_RTCUtil::activate(here.in());
    CHECK(other.host.wait_for_output("received ")); // 10 or more, when that many have come
    const auto names = open_objects();
    REQUIRE(names.size() == 1);
    CHECK(exists(names.front()));
    other.host.send_signal(SIGKILL);
    CHECK(eventually([&] { return counter.out_.getConnectorIds().empty(); }));
    CHECK(eventually([&] { return open_objects().empty(); }));
    CHECK_FALSE(exists(names.front()));
}
