// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/path_hosts.hpp"

#include <fstream>

namespace tandem::bench {

namespace {

namespace fs = std::filesystem;

/// A call whose caller or worker is stepped takes that much longer.
constexpr const char* call_timeout_ms = "20000";

/// The property `role` of the component that does the operation, and of the one that takes part.
struct Roles {
    std::string from, to;
};

std::string part_xml(const char* name, const std::string& role) {
    return component_xml(name, "BenchPath.xml", {{"role", role}});
}

/// BenchPath and the ports of the RTC behind AdaptorComp, in both directions.
std::string bridged_application(const std::string& role, const std::string& link) {
    return application_xml(
        part_xml("Path", role) +
            component_xml("Adaptor", "AdaptorComp.xml",
                          {{"link", link}, {"wait", "30"}, {"call_timeout", call_timeout_ms}}),
        connection_xml("data", "Path", "out", "Adaptor", "in") +
            connection_xml("data", "Adaptor", "out", "Path", "in") +
            connection_xml("service", "Path", "required", "Adaptor", "provided") +
            connection_xml("service", "Adaptor", "required", "Path", "provided"));
}

std::string local_application(const Roles& roles) {
    return application_xml(part_xml("From", roles.from) + part_xml("To", roles.to),
                           connection_xml("data", "From", "out", "To", "in") +
                               connection_xml("service", "From", "required", "To", "provided"));
}

std::string bridged_rtc_conf(const std::string& role, const std::string& link) {
    return rtc_conf_head + ("manager.modules.preload: BenchPath.so, InterceptorComp.so\n"
                            "manager.components.precreate: BenchPath?role=" +
                            role + ", InterceptorComp?link=" + link +
                            "&rtc=BenchPath0&call_timeout=" + call_timeout_ms + "\n");
}

std::string local_rtc_conf(const Roles& roles) {
    return rtc_conf_head +
           ("manager.modules.preload: BenchPath.so\nmanager.components.precreate: BenchPath?role=" +
            roles.from + ", BenchPath?role=" + roles.to +
            "\nmanager.components.preconnect: BenchPath0.out?port=BenchPath1.in&interface_type=direct, "
            "BenchPath0.required?port=BenchPath1.provided\n"
            "manager.components.preactivation: BenchPath0, BenchPath1\n");
}

} // namespace

PathHosts::PathHosts(Road road, bool is_call, const std::string& link, const fs::path& folder) : road_(road) {
    const Roles roles = is_call ? Roles{"call", "serve"} : Roles{"send", "receive"};
    const bool from_opros = road == Road::opros_to_rtm;
    fs::create_directory(folder); // removed with the case's leftovers
    if (road != Road::inside_rtm) {
        std::ofstream(folder / "app.xml")
            << (road == Road::inside_opros ? local_application(roles)
                                           : bridged_application(from_opros ? roles.from : roles.to, link));
        opros_.emplace(BenchHost::Model::opros, folder);
    }
    if (road != Road::inside_opros) {
        std::ofstream(folder / "rtc.conf")
            << (road == Road::inside_rtm ? local_rtc_conf(roles)
                                         : bridged_rtc_conf(from_opros ? roles.to : roles.from, link));
        rtm_.emplace(BenchHost::Model::rtm, folder);
    }
}

std::string PathHosts::first_log_lines() const {
    std::string out;
    for (const auto* host : {&opros_, &rtm_})
        if (*host) out += "; " + (*host)->first_log_line();
    return out;
}

} // namespace tandem::bench
