// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/manager/probe_module.hpp"

#include "host/plugin/abi.hpp"
#include "host/plugin/library.hpp"
#include "host/process/bounded_call.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/RTObject.h>
#include <rtm/TandemAbi.h>

namespace RTC {
namespace {

// Without the user's rtc.conf: nobody shall see this manager.
Manager& private_manager() {
    coil::Argv arguments(
        coil::vstring{"rtm_host", "-f", "/dev/null", "-o", "logger.enable:NO", "-o", "naming.enable:NO"});
    return Manager::start(static_cast<int>(arguments.size()), arguments.get(), Manager::Options());
}

} // namespace

std::string Manager::tryFactories(const std::function<void(const std::string&)>& before,
                                  std::chrono::nanoseconds patience) {
    std::string stuck;
    for (const auto& factory : m_impl->factories) {
        const std::string type = factory->profile().getProperty("implementation_id");
        before("the constructor of " + type);
        RTObject_impl& component = makeOrThrow(*factory);
        if (!stuck.empty()) continue;
        before("the destructor of " + type);
        component.finalizePorts();
        component.finalizeContexts();
        if (!tandem::process::BoundedCall::returns_within(patience, [&] { factory->destroy(&component); }))
            stuck = type;
    }
    return stuck;
}

void probe_module(const tandem::plugin::Probe& how, const std::string& library, const std::string& init,
                  Logger& rtclog) {
    // For all destructors: those that wait for a thread of theirs that never ends are no reason to do without
    // them.
    const auto patience = how.bound / 4;
    const std::string stuck =
        tandem::plugin::probe(how, module_probe_task, library, {init, std::to_string(patience.count())});
    if (!stuck.empty())
        RTC_WARN(
            ("module %s: the destructor of %s does not return; the host will leave such components as they "
             "are when they exit",
             library.c_str(), stuck.c_str()));
}

void run_module_probe(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report) {
    const std::string init = task.arguments.at(0);
    const std::chrono::milliseconds patience(std::stol(task.arguments.at(1)));
    report.stage("its static constructors");
    const auto library = tandem::plugin::Library::load(task.library);
    tandem::plugin::require_abi_of_process(tandem::plugin::Model::rtm, TANDEM_RTM_ABI, library->path());
    library->symbol<void(Manager*)>(init); // says so if there is none
    Manager& manager = private_manager();
    report.stage(init + "()");
    manager.loadOrThrow(task.library, init);
    try {
        const auto before = [&](const std::string& function) { report.stage(function); };
        report.finish(manager.tryFactories(before, patience));
    } catch (const ManagerError& e) {
        throw ManagerError("module " + task.library + ": " + e.what());
    }
}

} // namespace RTC
