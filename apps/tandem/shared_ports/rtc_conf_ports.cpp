// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"

#include "host/local/local_endpoint.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/plugin/probe.hpp"
#include "host/rtm/runtime/configuration/component_arguments.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include "proxy/interceptor/rtc_port.hpp"

#include <coil/stringutil.h>
#include <nlohmann/json.hpp>
#include <rtm/Manager.h>
#include <rtm/RTObject.h>

#include <chrono>
#include <cmath>
#include <span>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr char conf_task[] = "describe-rtc-conf";
constexpr char instances_task[] = "list-rtc-conf";
constexpr char types_task[] = "describe-rtc-types";

/// An InterceptorComp in the rtc.conf.
struct Sharing {
    std::string link, rtc;
};

std::string run_load_probe(const char* task, const char* subject, const fs::path& file,
                           const RtcConfOptions& options) {
    plugin::ProbeOptions probe;
    probe.timeout = std::chrono::milliseconds(static_cast<long>(options.timeout_s * 1000));
    probe.subject = subject;
    std::vector<std::string> dirs;
    for (const auto& dir : options.plugin_dirs) dirs.push_back(fs::absolute(dir).string());
    return plugin::run_probe(probe, task, fs::absolute(file), dirs);
}

// Starts a manager that is invisible outside: it binds no names, has no fixed endpoint, and activates nothing. [child
// process]
RTC::Manager& start_manager(const std::string& conf, const plugin::ProbeTask& task,
                            plugin::ProbeReport& report) {
    RTC::Manager::Options options;
    for (const auto& dir : task.arguments) options.plugin_path.emplace_back(dir);
    for (const auto& dir : plugin::default_plugin_dirs("rtm")) options.plugin_path.push_back(dir);
    options.on_setup_step = [&report](const std::string& step) { report.begin_stage(step); };
    coil::vstring arguments{"tandem", "-f", conf, "-a"};
    for (const char* setting : {"naming.enable:NO", "logger.enable:NO", "manager.is_master:NO",
                                "corba.endpoints:", "corba.endpoint:"}) {
        arguments.emplace_back("-o");
        arguments.emplace_back(setting);
    }
    coil::Argv argv(arguments);
    RTC::Manager& manager = RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    local::remove_local_endpoint(local::manager_endpoint);
    return manager;
}

// Removes InterceptorComps from the components to create, because they would open their links.
std::vector<Sharing> take_sharings(coil::Properties& config) {
    std::vector<Sharing> sharings;
    std::string others;
    for (const auto& entry : coil::split(config.getProperty("manager.components.precreate"), ",", true)) {
        const auto requested = RTC::parse_component_arguments(entry);
        if (requested.id.getProperty("implementation_id") == "InterceptorComp")
            sharings.push_back(
                {requested.properties.getProperty("link"), requested.properties.getProperty("rtc")});
        else
            others += (others.empty() ? "" : ",") + entry;
    }
    config.setProperty("manager.components.precreate", others);
    config.setProperty("manager.components.preconnect", "");
    config.setProperty("manager.components.preactivation", "");
    return sharings;
}

link::PortTable shared_table(RTC::Manager& manager, const Sharing& sharing) {
    try {
        return interceptor::look_up_shared_ports(manager, sharing.rtc);
    } catch (const std::runtime_error& error) {
        throw RTC::ManagerError(std::string("manager.components.precreate: InterceptorComp's ") +
                                error.what());
    }
}

// Creates all RTCs of the rtc.conf except InterceptorComps. Returns the latter in `sharings`.
RTC::Manager& carry_out(const plugin::ProbeTask& task, plugin::ProbeReport& report,
                        std::vector<Sharing>& sharings) {
    fs::current_path(fs::path(task.library).parent_path());
    report.begin_stage("the start of the manager");
    RTC::Manager& manager = start_manager(task.library, task, report);
    sharings = take_sharings(manager.getConfig());
    manager.activateOrThrow();
    return manager;
}

void serve_instances(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    std::vector<Sharing> sharings;
    json instances = json::array();
    for (auto* rtc : carry_out(task, report, sharings).getComponents()) {
        RTC::ExecutionContextList_var contexts = rtc->get_owned_contexts();
        const double rate = contexts->length() == 0 ? 0 : contexts[0]->get_rate();
        instances.push_back({rtc->getInstanceName(), rate > 0 ? std::llround(1e9 / rate) : 0});
    }
    report.finish(instances.dump());
}

void serve_conf(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    std::vector<Sharing> sharings;
    RTC::Manager& manager = carry_out(task, report, sharings);
    report.begin_stage("the ports of its RTCs");
    json tables = json::object();
    for (const auto& each : sharings) tables[each.link] = link::encode_as_text(shared_table(manager, each));
    report.finish(tables.dump());
}

void serve_types(const plugin::ProbeTask& task, plugin::ProbeReport& report) {
    report.begin_stage("the start of the manager");
    RTC::Manager& manager = start_manager("/dev/null", task, report);
    const auto built_in = manager.getFactoryProfiles().size(); // the manager's own composites come first
    manager.loadOrThrow(task.library, "");
    json types = json::array();
    const auto profiles = manager.getFactoryProfiles();
    for (const auto& profile : std::span(profiles).subspan(built_in))
        types.push_back({profile.getProperty("implementation_id"), profile.getProperty("category")});
    report.finish(types.dump());
}

} // namespace

std::map<std::string, link::PortTable> probe_rtc_conf(const fs::path& conf, const RtcConfOptions& options) {
    std::map<std::string, link::PortTable> tables;
    const json texts = json::parse(run_load_probe(conf_task, "rtc.conf", conf, options));
    for (const auto& [link, text] : texts.items())
        tables.emplace(link, link::decode_port_table_text(text.get<std::string>()));
    return tables;
}

std::vector<RtcInstance> probe_rtc_instances(const fs::path& conf, const RtcConfOptions& options) {
    std::vector<RtcInstance> instances;
    const json answer = json::parse(run_load_probe(instances_task, "rtc.conf", conf, options));
    for (const auto& each : answer)
        instances.push_back({each.at(0), std::chrono::nanoseconds(each.at(1).get<std::int64_t>())});
    return instances;
}

std::vector<RtcType> probe_rtc_types(const fs::path& module, const RtcConfOptions& options) {
    std::vector<RtcType> types;
    const json answer = json::parse(run_load_probe(types_task, "module", module, options));
    for (const auto& each : answer) types.push_back({each.at(0), each.at(1)});
    return types;
}

plugin::ProbeTasks rtc_probe_tasks() {
    return {{conf_task, serve_conf}, {instances_task, serve_instances}, {types_task, serve_types}};
}

} // namespace tandem::command
