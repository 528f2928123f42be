// SPDX-License-Identifier: Apache-2.0
#include "probe_module.hpp"

#include "host/plugin/library.hpp"
#include "manager_impl.hpp"
#include <rtm/RTObject.h>

namespace RTC {
namespace {

// Without the user's rtc.conf: nobody shall see this manager.
Manager& private_manager() {
    coil::Argv arguments(
        coil::vstring{"rtm_host", "-f", "/dev/null", "-o", "logger.enable:NO", "-o", "naming.enable:NO"});
    return Manager::start(static_cast<int>(arguments.size()), arguments.get(), Manager::Options());
}

} // namespace

void Manager::tryFactories(const std::function<void(const std::string&)>& before) {
    for (const auto& factory : m_impl->factories) {
        const std::string type = factory->profile().getProperty("implementation_id");
        before("the constructor of " + type);
        RTObject_impl& component = makeOrThrow(*factory);
        before("the destructor of " + type);
        component.finalizePorts();
        component.finalizeContexts();
        factory->destroy(&component);
    }
}

void try_module(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report) {
    const std::string init = task.arguments.at(0);
    report.stage("its static constructors");
    const auto library = tandem::plugin::Library::load(task.library);
    library->symbol<void(Manager*)>(init); // says so if there is none
    Manager& manager = private_manager();
    report.stage(init + "()");
    manager.loadOrThrow(task.library, init);
    try {
        manager.tryFactories([&](const std::string& function) { report.stage(function); });
    } catch (const ManagerError& e) {
        throw ManagerError("module " + task.library + ": " + e.what());
    }
}

} // namespace RTC
