// SPDX-License-Identifier: Apache-2.0
// A trial load of a module in a child process, so that a module that crashes or hangs is reported with the
// function at fault and does not take the host with it. OpenRTM-aist has no such step.
#include "host/rtm/runtime/manager/probe_module.hpp"

#include "host/local/local_endpoint.hpp"
#include "host/plugin/abi.hpp"
#include "host/plugin/library.hpp"
#include "host/process/bounded_call.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/RTObject.h>
#include <rtm/TandemAbi.h>

namespace RTC {
namespace {

// The child's manager. It ignores the user's rtc.conf, does not log and binds no names, so that nobody outside
// notices it.
Manager& private_manager() {
    coil::Argv arguments(
        coil::vstring{"rtm_host", "-f", "/dev/null", "-o", "logger.enable:NO", "-o", "naming.enable:NO"});
    Manager& manager =
        Manager::start(static_cast<int>(arguments.size()), arguments.get(), Manager::Options());
    tandem::local::remove_local_endpoint(
        tandem::local::manager_endpoint); // the process ends without shutting the ORB down
    return manager;
}

} // namespace

// Components are not initialized: onInitialize may need files, devices or other components. After the first
// destructor that hangs no other is called, since each could take the whole timeout again.
std::string Manager::tryFactories(const std::function<void(const std::string&)>& before,
                                  std::chrono::nanoseconds timeout) {
    std::string stuck;
    for (const auto& factory : m_impl->factories) {
        const std::string type = factory->profile().getProperty("implementation_id");
        before("the constructor of " + type);
        RTObject_impl& component = makeOrThrow(*factory);
        if (!stuck.empty()) continue;
        before("the destructor of " + type);
        component.finalizePorts();
        component.finalizeContexts();
        if (!tandem::process::BoundedCall::returns_within(timeout, [&] { factory->destroy(&component); }))
            stuck = type;
    }
    return stuck;
}

ModuleProbes::ModuleProbes(const tandem::plugin::ProbeOptions& options)
    : probes_(options, module_probe_task) {}

// A destructor that hangs only earns a warning, so it must not use up the time of the whole probe.
std::vector<std::string> ModuleProbes::arguments(const std::string& init) const {
    return {init, std::to_string((probes_.options().timeout / 4).count())};
}

void ModuleProbes::begin(const std::string& library, const std::string& init) {
    probes_.begin(library, arguments(init));
}

void ModuleProbes::finish(const std::string& library, const std::string& init, Logger& rtclog) {
    const std::string stuck = probes_.finish(library, arguments(init));
    if (!stuck.empty())
        RTC_WARN(
            ("module %s: the destructor of %s does not return; the host will not wait for it when such a "
             "component exits",
             library.c_str(), stuck.c_str()));
}

void run_module_probe(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report) {
    const std::string init = task.arguments.at(0);
    const std::chrono::milliseconds destructor_timeout(std::stol(task.arguments.at(1)));
    report.begin_stage("its static constructors");
    const auto library =
        tandem::plugin::Library::load(task.library, tandem::plugin::UndefinedFunctions::accept);
    tandem::plugin::require_abi_of_process(tandem::plugin::ComponentModel::rtm, TANDEM_RTM_ABI,
                                           library->path());
    library->symbol<void(Manager*)>(init); // throws when there is none
    Manager& manager = private_manager();
    report.begin_stage(init + "()");
    manager.loadOrThrow(task.library, init);
    try {
        const auto report_stage = [&](const std::string& function) { report.begin_stage(function); };
        report.finish(manager.tryFactories(report_stage, destructor_timeout));
    } catch (const ManagerError& e) {
        throw ManagerError("module " + task.library + ": " + e.what());
    }
}

} // namespace RTC
