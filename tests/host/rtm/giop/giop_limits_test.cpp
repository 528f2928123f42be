// SPDX-License-Identifier: Apache-2.0
// Well-formed requests that ask for too much: lengths without data, circular connections, impossible rates, a
// deep tree of settings, more connections than the host has descriptors.
#include "giop_message.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <limits>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>
#include <sys/resource.h>

using namespace testing;

namespace {

RTC::ConnectorProfile connection(std::initializer_list<RTC::PortService_ptr> ports) {
    RTC::ConnectorProfile profile;
    profile.name = CORBA::string_dup("c");
    profile.connector_id = CORBA::string_dup("c");
    for (auto* port : ports) CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(port));
    CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV("dataport.dataflow_type", "push"));
    CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV("dataport.interface_type", "corba_cdr"));
    return profile;
}

// Ends the arguments with the length of this number of bytes, which do not follow.
Call with_length(Call call, std::size_t at, std::uint32_t length) {
    for (const bool little : {false, true}) {
        call.arguments[little].resize(at + 4);
        for (std::size_t i = 0; i < 4; ++i)
            call.arguments[little][at + i] = static_cast<unsigned char>(length >> 8 * (little ? i : 3 - i));
    }
    return call;
}

} // namespace

TEST_CASE("A length without its data is refused and takes no memory") {
    RemoteHost other("Accumulator");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTC::RTObject_var accumulator = other.component(orb, "Accumulator0");
    RTM::Manager_var manager = other.manager(orb);
    RTC::PortService_var in = CORBA_RTCUtil::get_port_by_name(accumulator.in(), "in");
    RTC::ConnectorProfile profile = connection({in.in()});
    REQUIRE(in->notify_connect(profile) == RTC::RTC_OK);
    CORBA::Object_var in_port_cdr =
        orb->string_to_object(NVUtil::toString(profile.properties, "dataport.corba_cdr.inport_ior").c_str());
    const Call valid[] = {call(object_key(orb, in_port_cdr.in()), "put", CORBA::ULong(0)),
                          call("manager", "set_configuration", CORBA::ULong(0)),
                          call(object_key(orb, in.in()), "notify_disconnect", CORBA::ULong(0)),
                          call(object_key(orb, in.in()), "notify_connect", "c", "c", CORBA::ULong(0))};
    const long before = other.host.memory_mb(true);
    for (const auto& one : valid)
        for (const std::uint32_t length : {0x7fffffffu, 0x80000000u, 0xffffffffu, 0x3ffffffu})
            for (const bool little : {false, true}) {
                CAPTURE(one.operation, length, little);
                const Call broken = with_length(one, one.arguments[little].size() - 4, length);
                const int fd = connect_loopback(other.port);
                REQUIRE(fd >= 0);
                CHECK(
                    send_all(fd, request(broken.key, broken.operation, broken.arguments[little], 2, little)));
                unsigned char answer[24] = {};
                CHECK(recv(fd, answer, sizeof answer, MSG_WAITALL) == 24);
                CHECK(answer[7] == 1);  // a reply ...
                CHECK(answer[16] == 2); // ... with a system exception, in the byte order of this machine
                close(fd);
            }
    CHECK(other.host.memory_mb(true) < before + 50);
    RTC::RTCList_var components = manager->get_components();
    CHECK(components->length() == 1);
}

TEST_CASE("Requests that no component can carry out are refused and the host keeps running") {
    RemoteHost other("Accumulator,Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTC::RTObject_var accumulator = other.component(orb, "Accumulator0"),
                      counter = other.component(orb, "Counter0");
    RTC::PortService_var in = CORBA_RTCUtil::get_port_by_name(accumulator.in(), "in"),
                         out = CORBA_RTCUtil::get_port_by_name(counter.in(), "out");
    const long before = other.host.memory_mb(true);

    RTC::ExecutionContextList_var contexts = accumulator->get_owned_contexts();
    for (const double rate : {0., -1., 1e10, 1e308, 1e-300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()})
        CHECK(contexts[0]->set_rate(rate) == RTC::BAD_PARAMETER);
    CHECK(contexts[0]->set_rate(1000) == RTC::RTC_OK);
    CHECK(accumulator->initialize() == RTC::PRECONDITION_NOT_MET);

    RTC::ConnectorProfile twice = connection({in.in(), in.in()});
    CHECK(in->connect(twice) != RTC::RTC_OK);
    CHECK(in->notify_connect(twice) == RTC::BAD_PARAMETER);
    RTC::ConnectorProfile circle = connection({in.in(), out.in(), in.in()});
    CHECK(in->notify_connect(circle) == RTC::BAD_PARAMETER);
    RTC::ConnectorProfile others = connection({out.in()});
    CHECK(in->notify_connect(others) == RTC::BAD_PARAMETER);

    for (const char* length : {"2147483647", "1e18", "-1", "0", "many"}) {
        RTC::ConnectorProfile large = connection({in.in()});
        CORBA_SeqUtil::push_back(large.properties, NVUtil::newNV("dataport.buffer.length", length));
        CHECK(in->notify_connect(large) == RTC::BAD_PARAMETER);
    }
    RTC::ConnectorProfileList_var none = in->get_connector_profiles();
    CHECK(none->length() == 0);

    RTM::Manager_var manager = other.manager(orb);
    std::string deep(2000000, '.');
    for (std::size_t i = 0; i < deep.size(); i += 2) deep[i] = 'a';
    CHECK(manager->set_configuration((deep + "a").c_str(), "1") == RTC::RTC_OK);
    CHECK(manager->set_configuration("exec_cxt.periodic.rate", "1e300") == RTC::BAD_PARAMETER);
    CHECK(manager->set_configuration("", "1") == RTC::BAD_PARAMETER);
    RTM::NVList_var settings = manager->get_configuration();
    CHECK(NVUtil::find_index(settings.in(), (deep + "a").c_str()) >= 0);
    RTC::RTObject_var another = manager->create_component("Counter");
    CHECK_FALSE(CORBA::is_nil(another.in()));

    SDOPackage::Configuration_var configuration = counter->get_configuration();
    SDOPackage::ConfigurationSet set;
    set.description = CORBA::string_dup("");
    for (const char* id : {"", "default", "a.b"}) {
        set.id = CORBA::string_dup(id);
        CHECK_FALSE(configuration->add_configuration_set(set));
    }
    INFO("MB before " << before << ", peak " << other.host.memory_mb(true));
#ifdef __SANITIZE_THREAD__
    constexpr long more = 300; // the sanitizer shadows a key of 2 MB
#else
    constexpr long more = 100;
#endif
    CHECK(other.host.memory_mb(true) < before + more);
    CHECK(fixture.manager().getComponents().empty());
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 0);
}

TEST_CASE("Silent connections, more than the host has descriptors for, do not affect established ones") {
    RemoteHost other("Counter", unused_port(), {"manager.components.preactivation:Counter0"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:200"});
    auto* orb = fixture.manager().theORB();
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Accumulator0.in?port=rtcloc://127.0.0.1:" + other.port + "/Counter0.out");
    REQUIRE(ManagerFixture::activate(accumulator) == RTC::RTC_OK);
    RTM::Manager_var manager = other.manager(orb);
    REQUIRE_FALSE(manager->is_master());
    REQUIRE(eventually([&] { return accumulator.received_ > 10; }));
    const std::size_t before = other.host.descriptor_count();
    const rlimit few{before + 60, before + 60};
    REQUIRE(prlimit(other.host.pid(), RLIMIT_NOFILE, &few, nullptr) == 0);

    const Bytes whole = request("manager", "get_components", {}, 2, true);
    std::vector<int> open;
    for (std::size_t i = 0; i < 120; ++i) { // twice as many as it has descriptors for
        const int fd = connect_loopback(other.port);
        if (fd < 0) continue; // the listen queue is full as well
        open.push_back(fd);
        send_all(fd, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(i % whole.size())));
    }
    CHECK(open.size() > 60);
    for (int i = 0; i < 20; ++i) CHECK_FALSE(manager->is_master());
    const long received = accumulator.received_;
    CHECK(eventually([&] { return accumulator.received_ > received + 20; }));
    for (const int fd : open) close(fd);
    CHECK(eventually([&] { return other.host.descriptor_count() <= before + 1; }));
    const int fd = connect_loopback(other.port);
    REQUIRE(fd >= 0);
    CHECK(send_all(fd, whole));
    unsigned char answer[12] = {};
    CHECK(recv(fd, answer, sizeof answer, MSG_WAITALL) == 12);
    close(fd);
    RTC::RTObject_var here = accumulator.getObjRef();
    CORBA_RTCUtil::deactivate(here.in());
    CHECK(accumulator.sum_ > 0);
}
