// SPDX-License-Identifier: Apache-2.0
// Names in CORBA name servers that are started later than the host, end, and come back empty.
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "tests/host/rtm/name_server.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <catch2/catch.hpp>
#include <coil/stringutil.h>

using namespace testing;

namespace {

/// A CORBA client that looks names up.
struct Observer {
    Observer() {
        coil::Argv argv(coil::vstring{"test", "-ORBclientCallTimeOutPeriod", "5000", "-ORBtraceLevel", "0"});
        int argc = static_cast<int>(argv.size());
        orb = CORBA::ORB_init(argc, argv.get(), "omniORB4");
    }
    ~Observer() { orb->destroy(); }
    bool sees(const std::string& server, const std::string& path) {
        try {
            CosNaming::NamingContext_var root = RTC::resolve_name_server(orb.in(), server);
            CORBA::Object_var object = root->resolve(RTC::to_corba_name(path));
            return !CORBA::is_nil(object.in()) && !object->_non_existent();
        } catch (const RTC::RemoteUnavailable&) {
            return false;
        } catch (const CORBA::Exception&) {
            return false;
        }
    }
    CORBA::ORB_var orb;
};

} // namespace

TEST_CASE("Names are bound in a name server that starts later or has lost them, and unbound at the end") {
    const std::string port = unused_port(), server = "127.0.0.1:" + port;
    RemoteHost host("Counter", unused_port(),
                    {"corba.nameservers:" + server, "naming.update.interval:0.1",
                     "naming.formats:t.host_cxt/%n.rtc", "manager.naming_formats:t.host_cxt/%n.mgr"});
    REQUIRE(host.host.wait_for_output("ready\n")); // without waiting for the server
    Observer observer;
    auto both = [&] {
        return observer.sees(server, "t.host_cxt/Counter0.rtc") &&
               observer.sees(server, "t.host_cxt/manager.mgr");
    };
    {
        const NameServer names(port);
        CHECK(eventually(both));
        RTC::RTObject_var counter =
            RTC::resolve_component(observer.orb.in(), "rtcname://" + server + "/t.host_cxt/Counter0", {});
        CHECK_FALSE(CORBA::is_nil(counter.in()));
        counter = RTC::resolve_component(observer.orb.in(), "rtcname://*/*/Counter0", {server});
        CHECK_FALSE(CORBA::is_nil(counter.in()));
        CHECK_THROWS_WITH(
            RTC::resolve_component(observer.orb.in(), "rtcname://" + server + "/t.host_cxt/No0", {}),
            Catch::Contains("has no such entry"));
    }
    const NameServer names(port);
    CHECK(eventually(both));
    host.host.send_signal(SIGTERM);
    CHECK(host.host.wait_for_exit() == 0);
    CosNaming::NamingContext_var root = RTC::resolve_name_server(observer.orb.in(), server);
    for (const char* gone : {"t.host_cxt/Counter0.rtc", "t.host_cxt/manager.mgr"})
        CHECK_THROWS_AS(root->resolve(RTC::to_corba_name(gone)), CosNaming::NamingContext::NotFound);
}
