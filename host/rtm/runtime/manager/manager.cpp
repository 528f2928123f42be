// SPDX-License-Identifier: Apache-2.0
// The manager as the one object of its process, as OpenRTM-aist's Manager::init() and Manager::instance():
// its construction, and access to its settings. What it does is in the other manager_*.cpp.
#include "host/crash/crash_report.hpp"
#include "host/plugin/abi.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/sdo/shared_composite.hpp"
#include "host/text/printable.hpp"
#include <cstdio>
#include <cstdlib>
#include <rtm/CdrRingBuffer.h>
#include <rtm/ExtTrigExecutionContext.h>
#include <rtm/PeriodicExecutionContext.h>
#include <rtm/SimulatorExecutionContext.h>
#include <rtm/TandemAbi.h>

namespace RTC {
namespace {

std::mutex the_mutex; // guards the_manager
// Never deleted: components and static objects of plugins use the manager until the process ends.
Manager* the_manager = nullptr;
HostOptions the_options;

template <class Context>
void register_context(Manager& manager, const char* name) {
    manager.registerECFactory(name, ECCreate<Context>, ECDelete<Context>);
}

void register_contexts(Manager& manager) {
    register_context<RTC_exp::PeriodicExecutionContext>(manager, "PeriodicExecutionContext");
    // A separate module in OpenRTM-aist. Our periodic context already has the priority, the affinity and
    // the absolute time that RTPreemptEC is used for.
    register_context<RTC_exp::PeriodicExecutionContext>(manager, "RTPreemptEC");
    register_context<ExtTrigExecutionContext>(manager, "ExtTrigExecutionContext");
    register_context<SimulatorExecutionContext>(manager, "SimulatorExecutionContext");
    for (const char* name : {"SynchExtTriggerEC", "OpenHRPExecutionContext"})
        register_context<OpenHRPExecutionContext>(manager, name);
}

} // namespace

HostOptions host_options() { return the_options; }

Manager::Manager(const Options& options) : m_impl(std::make_unique<Impl>()) {
    m_impl->options = options;
    m_impl->owner = std::this_thread::get_id();
    the_options = options;
}
Manager::~Manager() = default;

Manager& Manager::start(int argc, char** argv, const Options& options) {
    std::lock_guard<std::mutex> lock(the_mutex);
    if (the_manager != nullptr) return *the_manager;
    // A component's own program is linked to this library, whatever headers it was built against.
    tandem::plugin::require_abi_of_process(tandem::plugin::ComponentModel::rtm, TANDEM_RTM_ABI);
    if (options.crash_report != nullptr) tandem::crash::install_crash_report(options.crash_report);
    std::unique_ptr<Manager> manager(new Manager(options));
    configure_process(*manager->m_impl, argc, argv);
    begin_module_probes(*manager->m_impl); // they run while the ORB starts
    start_orb(*manager->m_impl);
    register_contexts(*manager);
    CdrBufferFactory::instance().addFactory("ring_buffer", coil::Creator<CdrBufferBase, CdrRingBuffer>,
                                            coil::Destructor<CdrBufferBase, CdrRingBuffer>);
    register_shared_composite(*manager);
    manager->m_impl->naming_manager =
        std::make_unique<NamingManager>(manager.get(), *manager->m_impl->name_bindings);
    the_manager = manager.release();
    // From here on other threads and other processes call the manager.
    start_connection_keeper(*the_manager, *the_manager->m_impl);
    publish_manager(*the_manager, *the_manager->m_impl);
    return *the_manager;
}

Manager* Manager::init(int argc, char** argv) {
    try {
        return &start(argc, argv, Options());
    } catch (const std::runtime_error& e) {
        std::fprintf(stderr, "%s\n", tandem::text::printable_line(e.what()).c_str());
        std::exit(1);
    }
}

Manager& Manager::instance() {
    {
        std::lock_guard<std::mutex> lock(the_mutex);
        if (the_manager != nullptr) return *the_manager;
    }
    static char name[] = "tandem";
    char* argv[] = {name, nullptr};
    return *init(1, argv);
}

coil::Properties& Manager::getConfig() { return m_impl->config; }
std::string& Manager::getLogLevel() { return m_impl->config["logger.log_level"]; }
void Manager::setModuleInitProc(ModuleInitProc proc) { m_impl->init_proc = proc; }

coil::Properties Manager::Impl::config_snapshot() const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    return config;
}

std::string Manager::Impl::setting(const std::string& key) const {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    return config.getProperty(key);
}

bool Manager::Impl::change_setting(const std::string& key, std::string value) {
    if (key.empty() || !check_and_normalize_value(key, value)) return false;
    std::lock_guard<std::recursive_mutex> lock(mutex);
    config.setProperty(key, value);
    return true;
}

} // namespace RTC
