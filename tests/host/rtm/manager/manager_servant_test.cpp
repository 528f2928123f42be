// SPDX-License-Identifier: Apache-2.0
// The manager's CORBA interface as tools use it: modules, components, settings, shutdown and restart.
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/ManagerServant.h>
#include <rtm/NVUtil.h>

using namespace testing;

namespace {

std::vector<std::string> listed(const RTM::ModuleProfileList& profiles, const char* key) {
    std::vector<std::string> values;
    for (CORBA::ULong i = 0; i < profiles.length(); ++i)
        values.push_back(NVUtil::toString(profiles[i].properties, key));
    return values;
}

bool has(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

std::size_t components(RTM::Manager_ptr manager, const char* name) {
    RTC::RTCList_var found = manager->get_components_by_name(name);
    return found->length();
}

} // namespace

TEST_CASE("A tool sees which modules there are and loads and unloads them") {
    RemoteHost other(
        "", unused_port(),
        {"manager.is_master:YES", "corba.master_manager:" + unused_port(), "manager.modules.preload:"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    auto loadable = [&] {
        RTM::ModuleProfileList_var list = manager->get_loadable_modules();
        return listed(list.in(), "module_file_name");
    };
    auto loaded = [&] {
        RTM::ModuleProfileList_var list = manager->get_loaded_modules();
        return listed(list.in(), "module_file_name");
    };
    auto types = [&] {
        RTM::ModuleProfileList_var list = manager->get_factory_profiles();
        return listed(list.in(), "implementation_id");
    };
    CHECK(has(loadable(), "TestComponents.so"));
    CHECK_FALSE(has(loadable(), "BadModule.so")); // without an init function
    CHECK_FALSE(has(loadable(), "OldModule.so")); // built against another ABI number
    CHECK(loaded().empty());
    for (const char* wrong : {"BadModule.so", "OldModule.so", "Missing.so", "/dev/null", "", "/"}) {
        CAPTURE(wrong);
        CHECK(manager->load_module(wrong, "") == RTC::RTC_ERROR);
    }
    CHECK(loaded().empty());
    for (int life = 0; life < 3; ++life) {
        REQUIRE(manager->load_module("TestComponents.so", "TestComponentsInit") == RTC::RTC_OK);
        CHECK(loaded() == std::vector<std::string>{"TestComponents.so"});
        RTM::ModuleProfileList_var list = manager->get_loaded_modules();
        CHECK(listed(list.in(), "file_path") == listed(list.in(), "module_file_path"));
        CHECK(has(types(), "Counter"));
        RTC::RTObject_var counter = manager->create_component("Counter?instance_name=one");
        REQUIRE_FALSE(CORBA::is_nil(counter.in()));
        CHECK(manager->unload_module("TestComponents.so") == RTC::PRECONDITION_NOT_MET);
        CHECK(manager->delete_component("one") == RTC::RTC_OK);
        CHECK(eventually([&] { return manager->unload_module("TestComponents.so") == RTC::RTC_OK; }));
        CHECK(manager->unload_module("TestComponents.so") == RTC::BAD_PARAMETER);
        CHECK(loaded().empty());
        CHECK_FALSE(has(types(), "Counter"));
        CHECK(has(types(), "PeriodicECSharedComposite")); // not of a module
    }
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 0);
}

TEST_CASE("A tool creates and configures and deletes components and changes settings") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    RTC::RTObject_var made = manager->create_component("Counter?instance_name=x&step=5&manager_name=manager");
    REQUIRE_FALSE(CORBA::is_nil(made.in()));
    CHECK(CORBA_RTCUtil::get_default_rate(made.in()) == 200);
    CHECK(CORBA_RTCUtil::get_active_configuration(made.in()).getProperty("step") == "5");
    for (const char* wrong : {"", "?", "NoSuchType", "Counter?instance_name=x", "Counter?=&", "RTC:a:b",
                              "Counter?manager_name=other", "Counter?manager_address=127.0.0.1:9"}) {
        CAPTURE(wrong);
        RTC::RTObject_var none = manager->create_component(wrong);
        CHECK(CORBA::is_nil(none.in()));
    }
    CHECK(components(manager.in(), "*/Counter0") == 1);
    CHECK(components(manager.in(), "*/x") == 1);
    CHECK(manager->set_configuration("exec_cxt.periodic.rate", "50") == RTC::RTC_OK);
    RTC::RTObject_var slower = manager->create_component("Counter");
    CHECK(CORBA_RTCUtil::get_default_rate(slower.in()) == 50);
    RTC::ComponentProfileList_var profiles = manager->get_component_profiles();
    CHECK(profiles->length() == 3);
    CHECK(manager->delete_component("nobody") == RTC::BAD_PARAMETER);
    CHECK(manager->delete_component("x") == RTC::RTC_OK);
    CHECK(components(manager.in(), "x") == 0);
    CHECK(manager->fork() == RTC::UNSUPPORTED);
    CHECK(manager->shutdown() == RTC::RTC_OK);
    CHECK(other.host.wait_for_exit() == 0);
}

TEST_CASE("The profile of the manager has the keys that tools show") {
    ManagerFixture fixture;
    RTM::ManagerProfile_var profile = fixture.manager().getManagerServant().get_profile();
    const coil::Properties properties = NVUtil::toProperties(profile->properties);
    // The keys that rtcat of rtshell shows and that the manager of OpenRTM-aist 2.1 has.
    for (const char* key :
         {"name", "instance_name", "pid", "naming_formats", "language", "supported_languages",
          "corba_servant", "components.naming_policy", "components.preconnect", "components.preactivation",
          "modules.load_path", "modules.search_auto", "modules.config_path", "modules.init_func_prefix",
          "modules.init_func_suffix", "modules.download_allowed", "modules.abs_path_allowed"}) {
        CAPTURE(key);
        CHECK(properties.findNode(key) != nullptr);
    }
    CHECK(properties.getProperty("naming_formats") == "%h.host_cxt/%n.mgr");
    const coil::Properties settings =
        NVUtil::toProperties(RTC::NVList_var(fixture.manager().getManagerServant().get_configuration()).in());
    for (const char* key : {"os.name", "os.release", "os.version", "os.arch", "os.hostname"}) {
        CAPTURE(key);
        CHECK_FALSE(settings.getProperty(key).empty());
    }
}

TEST_CASE("A tool restarts the host, which comes back in its initial state") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    auto* orb = fixture.manager().theORB();
    RTM::Manager_var manager = other.manager(orb);
    RTC::RTObject_var added = manager->create_component("Reporter");
    CHECK(components(manager.in(), "Reporter0") == 1);
    const std::size_t descriptors = other.host.descriptor_count();
    CHECK(manager->restart() == RTC::RTC_OK);
    REQUIRE(other.host.wait_for_output("Reporter0 finalized\nready\n"));
    CHECK(eventually([&] { // the first call may still use the old connection
        try {
            return components(manager.in(), "Counter0") == 1;
        } catch (const CORBA::SystemException&) {
            return false;
        }
    }));
    CHECK(components(manager.in(), "Reporter0") == 0);
    CHECK(other.host.descriptor_count() <= descriptors + 1);
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 0);
}

TEST_CASE("A tool that asks for a component that can neither initialize nor be destroyed gets none") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    RTC::RTObject_var none =
        manager->create_component("FaultInjector?in=initialize&how=fail&instance_name=never");
    CHECK(CORBA::is_nil(none.in()));
    CHECK(components(manager.in(), "never") == 0);
    RTC::RTObject_var another = manager->create_component("Counter?instance_name=never");
    CHECK_FALSE(CORBA::is_nil(another.in()));
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 1);
    CHECK_THAT(other.host.errors, Catch::Contains("the destructor of never does not return"));
}

TEST_CASE("Only one of several simultaneous requests gets a component of the same name") {
    RemoteHost other("Counter");
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture;
    RTM::Manager_var manager = other.manager(fixture.manager().theORB());
    std::atomic<int> made{0};
    std::vector<std::thread> tools;
    for (int i = 0; i < 8; ++i)
        tools.emplace_back([&] {
            RTC::RTObject_var one = manager->create_component("Accumulator?instance_name=only");
            if (!CORBA::is_nil(one.in())) ++made;
        });
    for (auto& tool : tools) tool.join();
    CHECK(made == 1);
    CHECK(components(manager.in(), "only") == 1);
}
