// SPDX-License-Identifier: Apache-2.0
// Tools that observe a component: what they are notified of, and when this ends.
#include "ToolServicesSkel.h"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <condition_variable>
#include <rtm/NVUtil.h>

using namespace testing;

namespace {

/// Everything that a tool was told. [any-thread]
class Told {
  public:
    void add(const std::string& line) {
        std::lock_guard<std::mutex> lock(mutex_);
        lines_.push_back(line);
        changed_.notify_all();
    }
    bool wait_for_any() {
        std::unique_lock<std::mutex> lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return !lines_.empty(); });
    }
    bool wait_for(const std::string& line) {
        std::unique_lock<std::mutex> lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return count(line) > 0; });
    }
    std::ptrdiff_t number_of(const std::string& line) {
        std::lock_guard<std::mutex> lock(mutex_);
        return count(line);
    }

  private:
    std::ptrdiff_t count(const std::string& line) const {
        return std::count(lines_.begin(), lines_.end(), line);
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> lines_;
};

struct Observer : POA_OpenRTM::ComponentObserver, PortableServer::RefCountServantBase {
    void update_status(OpenRTM::StatusKind kind, const char* hint) override {
        told.add(std::to_string(static_cast<int>(kind)) + " " + hint);
        std::unique_lock<std::mutex> lock(busy); // held by a test: the tool hangs
    }
    Told told;
    std::mutex busy;
};

struct LogTool : POA_OpenRTM::Logger, PortableServer::RefCountServantBase {
    void publish(const OpenRTM::LogRecord& record) override {
        CHECK(record.time.sec > 1700000000);
        CHECK(record.time.nsec < 1000000000);
        told.add(std::string(record.loggername) + " " + std::to_string(static_cast<int>(record.level)) + " " +
                 static_cast<const char*>(record.message));
    }
    void close() override {}
    Told told;
};

template <class Service>
SDOPackage::ServiceProfile profile_of(const char* id, typename Service::_ptr_type service,
                                      const coil::Properties& settings = coil::Properties()) {
    SDOPackage::ServiceProfile profile;
    profile.id = CORBA::string_dup(id);
    profile.interface_type = CORBA::string_dup(Service::_PD_repoId);
    profile.service = SDOPackage::SDOService::_duplicate(service);
    NVUtil::copyFromProperties(profile.properties, settings);
    return profile;
}

// Counted, because the ORB may still call a tool at the end of a test.
template <class Tool>
using Served = PortableServer::Servant_var<Tool>;

} // namespace

TEST_CASE("An observer is notified of states, contexts, ports, messages, configuration and heartbeats") {
    RemoteHost other("Counter,Reporter", unused_port(),
                     {"manager.components.preconnect:Counter0.out?port=Reporter0.in"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    SDOPackage::Configuration_var configuration = counter->get_configuration();
    const Served<Observer> observer(new Observer);
    OpenRTM::ComponentObserver_var reference = observer->_this();
    coil::Properties settings;
    settings.setProperty("observed_status", "RTC_STATUS, ec_status, PORT_PROFILE, CONFIGURATION");
    settings.setProperty("heartbeat.enable", "YES");
    settings.setProperty("heartbeat.interval", "0.01");
    settings.setProperty("port_profile.send_event.min_interval", "0");
    REQUIRE(configuration->add_service_profile(
        profile_of<OpenRTM::ComponentObserver>("tool", reference.in(), settings)));
    RTC::ExecutionContext_var context = counter->get_context(0);
    CHECK(context->activate_component(counter.in()) == RTC::RTC_OK);
    CHECK(observer->told.wait_for("1 ACTIVE:0"));
    CHECK(observer->told.wait_for("3 SEND:OutPort:Counter0.out"));
    CHECK(context->set_rate(100) == RTC::RTC_OK);
    CHECK(observer->told.wait_for("2 RATE_CHANGED:0"));
    CHECK(configuration->activate_configuration_set("default"));
    CHECK(observer->told.wait_for("4 ACTIVATE_CONFIG_SET: default"));
    CHECK(context->deactivate_component(counter.in()) == RTC::RTC_OK);
    CHECK(observer->told.wait_for("1 INACTIVE:0"));
    RTC::PortServiceList_var ports = counter->get_ports();
    CHECK(ports[0]->disconnect_all() == RTC::RTC_OK);
    CHECK(observer->told.wait_for("3 DISCONNECT:Counter0.out"));
    CHECK(observer->told.wait_for("5 "));
    CHECK(observer->told.number_of("1 ACTIVE:0") == 1);

    CHECK(configuration->remove_service_profile("tool"));
    CHECK(context->activate_component(counter.in()) == RTC::RTC_OK);
    CHECK(context->deactivate_component(counter.in()) == RTC::RTC_OK);
    CHECK(observer->told.number_of("1 ACTIVE:0") == 1);
}

TEST_CASE("An observer of the end of a component is notified of it") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    SDOPackage::Configuration_var configuration = counter->get_configuration();
    const Served<Observer> observer(new Observer);
    OpenRTM::ComponentObserver_var reference = observer->_this();
    REQUIRE(
        configuration->add_service_profile(profile_of<OpenRTM::ComponentObserver>("tool", reference.in())));
    CHECK(counter->exit() == RTC::RTC_OK);
    CHECK(observer->told.wait_for("1 FINALIZE:0"));
}

TEST_CASE("A logger of a tool gets the lines of its component only") {
    RemoteHost other("Thrower,Thrower?instance_name=Thrower01");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    const Served<LogTool> tools[2]{new LogTool, new LogTool};
    for (int i = 0; i < 2; ++i) {
        RTC::RTObject_var thrower =
            other.component(fixture.manager().theORB(), i == 0 ? "Thrower0" : "Thrower01");
        SDOPackage::Configuration_var configuration = thrower->get_configuration();
        OpenRTM::Logger_var reference = tools[i]->_this();
        REQUIRE(configuration->add_service_profile(profile_of<OpenRTM::Logger>("tool", reference.in())));
        RTC::ExecutionContext_var context = thrower->get_context(0);
        context->activate_component(thrower.in()); // the component may be in ERROR before the answer
    }
    const std::string line = " 1 onExecute threw: on purpose";
    CHECK(tools[1]->told.wait_for("Thrower01" + line));
    CHECK(tools[0]->told.wait_for("Thrower0" + line));
    CHECK(tools[0]->told.number_of("Thrower01" + line) == 0);
    CHECK(tools[1]->told.number_of("Thrower0" + line) == 0);
}

TEST_CASE("A tool that hangs does not stop a component") {
    RemoteHost other("Counter,Reporter", unused_port(),
                     {"manager.components.preconnect:Counter0.out?port=Reporter0.in"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    SDOPackage::Configuration_var configuration = counter->get_configuration();
    coil::Properties settings;
    settings.setProperty("port_profile.send_event.min_interval", "0");
    const Served<Observer> hanging(new Observer);
    OpenRTM::ComponentObserver_var reference = hanging->_this();
    std::unique_lock<std::mutex> hang(hanging->busy);
    REQUIRE(configuration->add_service_profile(
        profile_of<OpenRTM::ComponentObserver>("tool", reference.in(), settings)));
    RTC::ExecutionContext_var context = counter->get_context(0);
    CHECK(context->activate_component(counter.in()) == RTC::RTC_OK);
    CHECK(hanging->told.wait_for_any());
    CHECK(context->deactivate_component(counter.in()) == RTC::RTC_OK);
    CHECK(context->activate_component(counter.in()) == RTC::RTC_OK);
    CHECK(hanging->told.number_of("3 SEND:OutPort:Counter0.out") <= 1);
    hang.unlock();
}

TEST_CASE("A service may be added and removed while its heartbeats are due") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    SDOPackage::Configuration_var configuration = counter->get_configuration();
    const Served<Observer> observer(new Observer);
    OpenRTM::ComponentObserver_var reference = observer->_this();
    coil::Properties settings;
    settings.setProperty("heartbeat.enable", "YES");
    settings.setProperty("heartbeat.interval", "0.001");
    for (std::ptrdiff_t i = 0; i < 50; ++i) {
        REQUIRE(configuration->add_service_profile(
            profile_of<OpenRTM::ComponentObserver>("tool", reference.in(), settings)));
        CHECK(eventually([&] { return observer->told.number_of("5 ") > i; }));
        REQUIRE(configuration->remove_service_profile("tool"));
    }
    CHECK_FALSE(counter->_non_existent());
}

TEST_CASE("The services of tools that have ended give their places to others") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTC::RTObject_var counter = other.component(fixture.manager().theORB(), "Counter0");
    SDOPackage::Configuration_var configuration = counter->get_configuration();
    const Served<Observer> observer(new Observer);
    OpenRTM::ComponentObserver_var living = observer->_this();
    CORBA::Object_var nobody = fixture.manager().theORB()->string_to_object(
        ("corbaloc:iiop:127.0.0.1:" + unused_port() + "/tool").c_str());
    SDOPackage::SDOService_var dead = SDOPackage::SDOService::_unchecked_narrow(nobody.in());
    for (int i = 0; i < 32; ++i)
        REQUIRE(configuration->add_service_profile(
            profile_of<OpenRTM::ComponentObserver>(std::to_string(i).c_str(), living.in())));
    CHECK_FALSE(
        configuration->add_service_profile(profile_of<OpenRTM::ComponentObserver>("32", living.in())));
    auto of_dead = profile_of<OpenRTM::ComponentObserver>("0", living.in());
    of_dead.service = SDOPackage::SDOService::_duplicate(dead.in());
    REQUIRE(configuration->add_service_profile(of_dead)); // now of a tool that has ended
    RTC::ExecutionContext_var context = counter->get_context(0);
    CHECK(context->activate_component(counter.in()) == RTC::RTC_OK);
    CHECK(eventually([&] {
        return configuration->add_service_profile(profile_of<OpenRTM::ComponentObserver>("32", living.in()));
    }));
    CHECK_FALSE(configuration->remove_service_profile("0"));
    CHECK(configuration->remove_service_profile("32"));
}
