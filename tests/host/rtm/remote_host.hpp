// SPDX-License-Identifier: Apache-2.0
// An rtm_host with the test components in another process, reached by CORBA alone.
#pragma once
#include "host_process.hpp"
#include <cstring>
#include <rtm/PortBase.h>
#include <rtm/idl/ManagerSkel.h>

namespace testing {

/// Polls until the condition is true, for about 20 s.
template <class Condition>
bool eventually(Condition condition) {
    for (int i = 0; i < 20000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

/// Runs `components` on 127.0.0.1:`port`, at 200 Hz; killed at the end, unless it has ended before.
struct RemoteHost {
    explicit RemoteHost(const std::string& components = "Counter,Reporter,CalculatorProvider",
                        std::string at = unused_port(), std::vector<std::string> settings = {})
        : port(std::move(at)), host(arguments(components, port, settings)) {}

    static std::vector<std::string> arguments(const std::string& components, const std::string& port,
                                              const std::vector<std::string>& settings) {
        std::vector<std::string> all{"-f",      "/dev/null",
                                     "-o",      "manager.modules.load_path:" TANDEM_TEST_PLUGINS,
                                     "-o",      "manager.modules.preload:TestComponents.so",
                                     "-o",      "manager.components.precreate:" + components,
                                     "-o",      "exec_cxt.periodic.rate:200",
                                     "-p",      port,
                                     "--grace", "2"};
        for (const auto& setting : settings) {
            all.push_back("-o");
            all.push_back(setting);
        }
        return all;
    }
    /// By the well-known key of its manager; the caller releases the reference.
    RTM::Manager_ptr manager(CORBA::ORB_ptr orb) const {
        CORBA::Object_var object =
            orb->string_to_object(("corbaloc:iiop:127.0.0.1:" + port + "/manager").c_str());
        return RTM::Manager::_narrow(object.in());
    }
    /// Nil: it has no component of that name.
    RTC::RTObject_ptr component(CORBA::ORB_ptr orb, const char* name) const {
        RTM::Manager_var remote_manager = manager(orb);
        RTC::RTCList_var found = remote_manager->get_components_by_name(name);
        return found->length() == 1 ? RTC::RTObject::_duplicate(found[0]) : RTC::RTObject::_nil();
    }
    std::string port;
    HostProcess host;
};

inline const std::string short_check_interval = "manager.peer_check_interval:0.05"; // in s

inline std::size_t connection_count(RTC::PortBase& port) {
    RTC::ConnectorProfileList_var list = port.get_connector_profiles();
    return list->length();
}

} // namespace testing
