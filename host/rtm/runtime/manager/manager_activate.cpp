// SPDX-License-Identifier: Apache-2.0
// What the manager does when it is activated: loads, creates, connects and activates what rtc.conf names.
// OpenRTM-aist: Manager::activateManager(), initPreCreation(), initPreConnection(), initPreActivation().
#include "host/rtm/runtime/manager/manager_impl.hpp"

namespace RTC {
namespace {

constexpr const char* module_keys[] = {"manager.preload.modules",
                                       "manager.modules.preload"}; // 1.x has the first form

struct ModuleEntry {
    std::string name, init_function; // the latter may be empty
};

// `FILE` or `FILE(INIT_FUNCTION)`
ModuleEntry parse_module_entry(const std::string& entry) {
    const std::size_t open = entry.find('(');
    const std::size_t close = entry.find(')', open);
    const std::string init = open == std::string::npos ? "" : entry.substr(open + 1, close - open - 1);
    return {coil::eraseBothEndsBlank(entry.substr(0, open)), coil::eraseBothEndsBlank(init)};
}

void load_module(Manager& manager, const std::string& entry) {
    manager.impl().begin_setup_step("the loading of module " + entry);
    const auto [name, init_function] = parse_module_entry(entry);
    manager.loadOrThrow(name, init_function);
}

/// While it exists, a requested end waits: components that are created meanwhile would be left out.
class SetUpScope {
  public:
    explicit SetUpScope(Manager::Impl& impl) : impl_(impl) { impl_.set_setting_up(true); }
    ~SetUpScope() { impl_.set_setting_up(false); }
    SetUpScope(const SetUpScope&) = delete;
    SetUpScope& operator=(const SetUpScope&) = delete;

  private:
    Manager::Impl& impl_;
};

// In OpenRTM-aist's order. `attempt(key, action)` runs one action and decides what a ManagerError means;
// `key` is the prefix of its message.
template <class Attempt>
void activate_all(Manager& manager, ModuleInitProc init_proc, Attempt attempt) {
    const SetUpScope scope(manager.impl());
    const coil::Properties& config = manager.getConfig();
    auto for_each_entry = [&](const char* key, auto action) {
        for (const auto& entry : coil::split(config.getProperty(key), ",", true))
            attempt(std::string(key) + ": ", [&] { action(entry); });
    };
    for (const char* key : module_keys)
        for_each_entry(key, [&](const std::string& entry) { load_module(manager, entry); });
    // After the modules, because they bring the factories of log streams.
    attempt("", [&] { open_log_streams(manager.impl()); });
    if (init_proc != nullptr) init_proc(&manager);
    for_each_entry("manager.components.precreate",
                   [&](const std::string& entry) { manager.createOrThrow(entry); });
    for_each_entry("manager.components.preconnect", [&](const std::string& entry) {
        manager.impl().begin_setup_step("the connection " + entry);
        manager.connectOrThrow(entry);
    });
    for_each_entry("manager.components.preactivation",
                   [&](const std::string& entry) { manager.activateComponentOrThrow(entry); });
}

} // namespace

void begin_module_probes(Manager::Impl& impl) {
    if (!impl.options.probe) return;
    impl.probes = std::make_unique<ModuleProbes>(*impl.options.probe);
    for (const char* key : module_keys)
        for (const auto& entry : coil::split(impl.setting(key), ",", true)) {
            const auto [name, init_function] = parse_module_entry(entry);
            try {
                const auto module = impl.find_module(name, init_function);
                if (!module.trusted) impl.probes->begin(module.file, module.init);
            } catch (const std::runtime_error&) { // loadOrThrow() finds the same
            }
        }
}

bool Manager::activateManager() {
    Logger& rtclog = m_impl->log;
    activate_all(*this, m_impl->init_proc, [&](const std::string& key, auto action) {
        try {
            action();
        } catch (const ManagerError& e) {
            RTC_ERROR(("%s%s", key.c_str(), e.what()));
        }
    });
    return true;
}

// rtm_host stops at the first error: a system with a missing part is not the system that rtc.conf asks for.
void Manager::activateOrThrow() {
    const std::string file = m_impl->conf_file.string();
    activate_all(*this, m_impl->init_proc, [&](const std::string& key, auto action) {
        try {
            action();
        } catch (const ManagerError& e) {
            throw ManagerError((file.empty() ? "" : file + ": ") + key + e.what());
        }
    });
}

} // namespace RTC
