// SPDX-License-Identifier: Apache-2.0
// Another rtm_host with the test components, reached by CORBA alone.
#pragma once
#include "host_process.hpp"
#include <cstring>
#include <netinet/in.h>
#include <rtm/idl/ManagerSkel.h>
#include <sys/socket.h>

namespace testing {

inline std::string unused_port() {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(fd, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
    close(fd);
    return std::to_string(ntohs(address.sin_port));
}

template <class Condition>
bool eventually(Condition condition) {
    for (int i = 0; i < 20000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

/// Reached through its manager's well-known name.
struct RemoteHost {
    explicit RemoteHost(const std::string& components = "Counter,Reporter,CalculatorProvider",
                        std::string at = unused_port(), std::vector<std::string> settings = {})
        : port(std::move(at)), host(arguments(components, port, settings)) {}

    static std::vector<std::string> arguments(const std::string& components, const std::string& port,
                                              const std::vector<std::string>& settings) {
        std::vector<std::string> all{"-f", "/dev/null",
                                     "-o", "manager.modules.load_path:" TANDEM_TEST_PLUGINS,
                                     "-o", "manager.modules.preload:TestComponents.so",
                                     "-o", "manager.components.precreate:" + components,
                                     "-o", "exec_cxt.periodic.rate:200",
                                     "-p", port};
        for (const auto& setting : settings) {
            all.push_back("-o");
            all.push_back(setting);
        }
        return all;
    }
    RTM::Manager_ptr manager(CORBA::ORB_ptr orb) const {
        CORBA::Object_var object =
            orb->string_to_object(("corbaloc:iiop:127.0.0.1:" + port + "/manager").c_str());
        return RTM::Manager::_narrow(object.in());
    }
    RTC::RTObject_ptr component(CORBA::ORB_ptr orb, const char* name) const {
        RTM::Manager_var there = manager(orb);
        RTC::RTCList_var found = there->get_components_by_name(name);
        return found->length() == 1 ? RTC::RTObject::_duplicate(found[0]) : RTC::RTObject::_nil();
    }
    std::string port;
    HostProcess host;
};

} // namespace testing
