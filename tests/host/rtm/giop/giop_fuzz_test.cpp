// SPDX-License-Identifier: Apache-2.0
// Broken GIOP messages to every servant of a host. Meanwhile the host must serve its other clients, keep their
// connections, and grow neither in memory nor in descriptors. TANDEM_STRESS=100 makes it 10^6 messages.
#include "giop_mutator.hpp"
#include "tests/host/rtm/manager_fixture.hpp"
#include "tests/host/rtm/remote_host.hpp"
#include "tests/support/stress.hpp"
#include <cstdlib>
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/NVUtil.h>

using namespace testing;

CATCH_TRANSLATE_EXCEPTION(const CORBA::SystemException& e) {
    const char* minor = e.NP_minorString();
    return std::string("CORBA exception ") + e._name() + " " + (minor != nullptr ? minor : "");
}

namespace {

SDOPackage::NVList some_properties() {
    SDOPackage::NVList list;
    CORBA_SeqUtil::push_back(list, NVUtil::newNV("dataport.dataflow_type", "push"));
    CORBA_SeqUtil::push_back(list, NVUtil::newNV("dataport.interface_type", "corba_cdr"));
    CORBA_SeqUtil::push_back(list, NVUtil::newNV("dataport.buffer.length", "4"));
    CORBA_SeqUtil::push_back(list, NVUtil::newNV("number", CORBA::Long(7)));
    return list;
}

/// The components that are attacked, and valid calls of every operation that they and their manager offer.
class FuzzTargets {
  public:
    FuzzTargets(const RemoteHost& host, CORBA::ORB_ptr orb)
        : orb_(CORBA::ORB::_duplicate(orb)), manager_(host.manager(orb)) {}

    /// Replaces the components by new ones and returns the calls. Done in each round, because messages may have
    /// made them exit or changed their configuration.
    std::vector<Call> renew() {
        calls_.clear();
        add_manager();
        for (const char* type : {"Counter", "Accumulator", "CalculatorProvider", "CalculatorConsumer"}) {
            const std::string name = std::string("Target") + type;
            manager_->delete_component(name.c_str());
            REQUIRE(eventually([&] {
                RTC::RTCList_var left = manager_->get_components_by_name(name.c_str());
                return left->length() == 0;
            }));
            RTC::RTObject_var component =
                manager_->create_component((std::string(type) + "?instance_name=" + name).c_str());
            REQUIRE_FALSE(CORBA::is_nil(component.in()));
            add_component(component.in());
        }
        return calls_;
    }

  private:
    template <class... Arguments>
    void add(CORBA::Object_ptr object, const char* operation, const Arguments&... arguments) {
        calls_.push_back(call(object_key(orb_.in(), object), operation, arguments...));
    }
    void add_all(CORBA::Object_ptr object, std::initializer_list<const char*> operations) {
        for (const char* operation : operations) add(object, operation);
    }

    // Without shutdown, restart, load_module, create_component and delete_component, which would be carried out.
    void add_manager() {
        add_all(manager_.in(),
                {"get_loadable_modules", "get_loaded_modules", "get_factory_profiles", "get_components",
                 "get_component_profiles", "get_profile", "get_configuration", "is_master",
                 "get_master_managers", "get_slave_managers", "fork", "_non_existent", "_interface"});
        for (const char* operation : {"get_components_by_name", "get_service", "unload_module", "_is_a"})
            add(manager_.in(), operation, "some.name");
        add(manager_.in(), "set_configuration", "some.key", "value");
        for (const char* operation :
             {"add_master_manager", "add_slave_manager", "remove_slave_manager", "remove_master_manager"})
            add(manager_.in(), operation, CORBA::Object_ptr(manager_.in()));
    }

    void add_component(RTC::RTObject_ptr component) {
        add_all(component,
                {"get_owned_contexts", "get_participating_contexts", "get_component_profile", "get_ports",
                 "get_sdo_id", "get_sdo_type", "get_device_profile", "get_service_profiles",
                 "get_configuration", "get_monitoring", "get_organizations", "get_owned_organizations",
                 "get_status_list", "initialize", "finalize"});
        for (const char* operation :
             {"get_context", "detach_context", "on_startup", "on_shutdown", "on_activated", "on_deactivated",
              "on_aborting", "on_error", "on_reset", "on_execute", "on_state_update", "on_rate_changed"})
            add(component, operation, CORBA::Long(0));
        for (const char* operation : {"get_service_profile", "get_sdo_service", "get_status"})
            add(component, operation, "name");
        RTC::ExecutionContextList_var contexts = component->get_owned_contexts();
        for (const char* operation : {"is_alive", "attach_context", "get_context_handle"})
            add(component, operation, CORBA::Object_ptr(contexts[0]));
        add_context(contexts[0], component);
        SDOPackage::Configuration_var configuration = component->get_configuration();
        add_configuration(configuration.in());
        RTC::PortServiceList_var ports = component->get_ports();
        for (CORBA::ULong i = 0; i < ports->length(); ++i) add_port(ports[i]);
        if (CORBA_RTCUtil::get_component_profile(component).getProperty("type_name") == "CalculatorConsumer")
            add_all(component, {"exit"}); // only one, since the call ends it
    }

    void add_context(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component) {
        add_all(context, {"is_running", "get_rate", "get_kind", "get_profile", "start", "stop"});
        add(context, "set_rate", CORBA::Double(100));
        for (const char* operation : {"add_component", "remove_component", "activate_component",
                                      "deactivate_component", "reset_component", "get_component_state"})
            add(context, operation, CORBA::Object_ptr(component));
    }

    void add_configuration(SDOPackage::Configuration_ptr configuration) {
        add_all(configuration, {"get_configuration_parameters", "get_configuration_parameter_values",
                                "get_configuration_sets", "get_active_configuration_set"});
        for (const char* operation :
             {"get_configuration_parameter_value", "get_configuration_set", "remove_configuration_set",
              "activate_configuration_set", "remove_service_profile", "remove_organization"})
            add(configuration, operation, "default");
        SDOPackage::ConfigurationSet set;
        set.id = CORBA::string_dup("default");
        set.description = CORBA::string_dup("");
        set.configuration_data = some_properties();
        add(configuration, "set_configuration_set_values", set);
        add(configuration, "add_configuration_set", set);
        CORBA::Any value;
        value <<= "2";
        add(configuration, "set_configuration_parameter", "step", value);
        SDOPackage::ServiceProfile service;
        service.id = CORBA::string_dup("id");
        service.interface_type = CORBA::string_dup("type");
        service.properties = some_properties();
        add(configuration, "add_service_profile", service);
        SDOPackage::DeviceProfile device;
        for (auto* text : {&device.device_type, &device.manufacturer, &device.model, &device.version})
            *text = CORBA::string_dup("text");
        device.properties = some_properties();
        add(configuration, "set_device_profile", device);
    }

    void add_port(RTC::PortService_ptr port) {
        add_all(port, {"get_port_profile", "get_connector_profiles", "disconnect_all"});
        for (const char* operation : {"get_connector_profile", "disconnect", "notify_disconnect"})
            add(port, operation, "one");
        RTC::ConnectorProfile profile;
        profile.name = CORBA::string_dup("one");
        profile.connector_id = CORBA::string_dup("");
        CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(port));
        profile.properties = some_properties();
        add(port, "connect", profile);
        profile.connector_id = CORBA::string_dup("one");
        add(port, "notify_connect", profile);
        for (const char* type : {"corba_cdr", "data_service"})
            for (const char* flow : {"push", "pull"}) {
                profile.connector_id = CORBA::string_dup((std::string(type) + flow).c_str());
                profile.properties[0].value <<= flow;
                profile.properties[1].value <<= type;
                add_data(port, profile);
            }
    }

    // Connects this port alone, so that it publishes the servants that receive or send data in the profile.
    void add_data(RTC::PortService_ptr port, RTC::ConnectorProfile profile) {
        if (port->notify_connect(profile) != RTC::RTC_OK) return;
        OpenRTM::CdrData bytes;
        bytes.length(12);
        for (const char* type : {"corba_cdr", "data_service"})
            for (const char* direction : {"inport", "outport"}) {
                const std::string key = std::string("dataport.") + type + "." + direction + "_ior";
                const std::string ior = NVUtil::toString(profile.properties, key.c_str());
                if (ior.empty()) continue;
                CORBA::Object_var object = orb_->string_to_object(ior.c_str());
                add(object.in(), "put", bytes);
                add(object.in(), "push", bytes);
                add_all(object.in(), {"get", "pull"});
            }
    }

    CORBA::ORB_var orb_;
    RTM::Manager_var manager_;
    std::vector<Call> calls_;
};

/// Sends broken calls over one connection, and opens another when the host closes it, or at random.
class FuzzClient {
  public:
    FuzzClient(std::string port, unsigned seed) : port_(std::move(port)), mutator_(seed) {}
    ~FuzzClient() { hang_up(); }

    void send_one(const std::vector<Call>& calls) {
        for (const auto& message : mutator_.mutate(calls)) {
            if (fd_ < 0) fd_ = connect_loopback(port_);
            REQUIRE(fd_ >= 0);
            const bool sent = send_all(fd_, message);
            char answer[4096];
            while (recv(fd_, answer, sizeof answer, MSG_DONTWAIT) > 0) continue;
            if (!sent) hang_up(); // the host has closed the connection
        }
        if (mutator_.random_below(16) == 0) hang_up();
    }

  private:
    void hang_up() {
        if (fd_ >= 0) close(fd_);
        fd_ = -1;
    }
    std::string port_;
    Mutator mutator_;
    int fd_ = -1;
};

} // namespace

TEST_CASE("A host survives broken GIOP messages to all its servants and serves its other clients meanwhile") {
    const long messages = tandem::test::stress(10000L);
    constexpr long each_round = 1000;
    // For a host built with the address sanitizer: omniORB leaks memory of broken messages (see below), and the
    // stack traces do not tell its leaks from ours. Leaks of our code show in the host's memory, checked below.
    setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
    // References in broken messages may contain any address; the host may only call those of this machine.
    RemoteHost other("Counter", unused_port(),
                     {"manager.components.preactivation:Counter0", "logger.enable:NO",
                      "corba.args:-ORBclientTransportRule \"127.0.0.1/255.255.255.255 unix,tcp\" "
                      "-ORBclientTransportRule \"* none\" -ORBclientCallTimeOutPeriod 1000"});
    REQUIRE(other.host.wait_for_output("ready\n"));
    ManagerFixture fixture(false, {"exec_cxt.periodic.rate:200"});
    auto* orb = fixture.manager().theORB();
    auto& accumulator = fixture.create<Accumulator>("Accumulator");
    fixture.connect("Accumulator0.in?port=rtcloc://127.0.0.1:" + other.port +
                    "/Counter0.out&buffer.length=10000");
    REQUIRE(ManagerFixture::activate(accumulator) == RTC::RTC_OK);
    RTC::RTObject_var counter = other.component(orb, "Counter0");
    REQUIRE(eventually([&] { return accumulator.received_ > 10; }));

    FuzzTargets targets(other, orb);
    targets.renew();
    const std::size_t descriptors = other.host.descriptor_count();
    const long memory = other.host.memory_mb();
    for (long round = 0; round < messages / each_round; ++round) {
        INFO("round " << round << "; the host: " << other.host.errors);
        const auto calls = targets.renew();
        REQUIRE(calls.size() > 200);
        FuzzClient client(other.port, static_cast<unsigned>(20261121 + round));
        for (long i = 0; i < each_round; ++i) client.send_one(calls);
        REQUIRE(CORBA_RTCUtil::is_in_active(counter.in()));
    }
    const long before = accumulator.received_;
    RTC::ConnectorProfileList_var connections = accumulator.in_.get_connector_profiles();
    CHECK(connections->length() == 1);
    CHECK(eventually([&] { return accumulator.received_ > before + 10; }));
    // The values are consecutive, so their sum shows that none was lost or changed. The component is deactivated
    // first, so that no value is added while the sums are compared.
    RTC::RTObject_var here = accumulator.getObjRef();
    CORBA_RTCUtil::deactivate(here.in());
    const long n = accumulator.received_, first = accumulator.value_.data - n + 1;
    CHECK(accumulator.sum_ == n * (first + accumulator.value_.data) / 2);
    targets.renew();
    // omniORB forgets 3 to 5 of 10^6 connections that end with a broken message: their sockets stay, half
    // closed, and its scan for idle connections only shuts them down.
    const auto bound = descriptors + 4 + static_cast<std::size_t>(messages / 100000);
    const bool flat = eventually([&] { return other.host.descriptor_count() <= bound; });
    CAPTURE(descriptors, other.host.descriptor_count());
    CHECK(flat);
    INFO("MB before " << memory << ", after " << other.host.memory_mb() << ", peak "
                      << other.host.memory_mb(true));
    // omniORB never frees the GIOP_S, with its 8 kB buffers, of a connection that ends after its reply was
    // sent (giopStrand::releaseServer): 130 to 200 B for each of these messages, nearly all that
    // LeakSanitizer finds. The rest is the allocator's, after messages that took 1 GB while they were
    // decoded.
    // The address sanitizer's allocator gives even less back: 660 MB more after 10^6.
    const long kept = 200 + messages / 4000;
#ifdef __SANITIZE_ADDRESS__
    CHECK(other.host.memory_mb() < memory + 2 * kept);
#else
    CHECK(other.host.memory_mb() < memory + kept);
#endif
    other.host.send_signal(SIGTERM);
    CHECK(other.host.wait_for_exit() == 0);
}
