// SPDX-License-Identifier: Apache-2.0
// The manager's settings: defaults, rtc.conf, command line, in this order of precedence from low to high, as
// in OpenRTM-aist's Manager::initManager(), ManagerConfig and Manager::initLogger().
#include "host/rt/thread.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/format_name.hpp"
#include "host/rtm/runtime/configuration/manager_settings.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <rtm/ManagerConfig.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace RTC {
namespace {

// Default values of OpenRTM-aist's DefaultConfiguration.h, with one exception: corba.endpoints is every address there
// and empty here. So no TCP port is open unless the user asks for one.
const std::pair<const char*, const char*> default_settings[] = {
    {"config.version", openrtm_version},
    {"openrtm.name", openrtm_name},
    {"openrtm.version", openrtm_version},
    {"manager.instance_name", "manager"},
    {"manager.name", "manager"},
    {"manager.naming_formats", "%h.host_cxt/%n.mgr"},
    {"manager.modules.load_path", "./"},
    {"manager.modules.abs_path_allowed", "YES"},
    {"manager.modules.search_auto", "YES"},
    {"manager.components.naming_policy", "process_unique"},
    {"manager.components.preconnect", ""},
    {"manager.components.preactivation", ""},
    {"manager.corba_servant", "YES"},
    // Without effect. Tools read them in the manager's profile.
    {"manager.language", "C++"},
    {"manager.supported_languages", "C++"},
    {"manager.modules.config_path", ""},
    {"manager.modules.init_func_prefix", ""},
    {"manager.modules.init_func_suffix", "Init"},
    {"manager.modules.download_allowed", "NO"},
    {"manager.is_master", "NO"},
    {"manager.shutdown_on_nortcs", "YES"},
    {"manager.shutdown_auto", "YES"},
    {"manager.auto_shutdown_duration", "20.0"},
    {"logger.enable", "YES"},
    {"logger.log_level", "INFO"},
    {"naming.formats", "%h.host_cxt/%n.rtc"},
    {"exec_cxt.periodic.type", "PeriodicExecutionContext"},
    {"exec_cxt.periodic.rate", "1000"},
    {"exec_cxt.sync_transition", "YES"},
    {"exec_cxt.transition_timeout", "0.5"},
};

void describe_system(coil::Properties& config) {
    utsname system{};
    ::uname(&system);
    config.setProperty("os.name", system.sysname);
    config.setProperty("os.release", system.release);
    config.setProperty("os.version", system.version);
    config.setProperty("os.arch", system.machine);
    config.setProperty("os.hostname", system.nodename);
}

void set_up_logger(const coil::Properties& config, Logger& log) {
    if (!coil::toBool(config.getProperty("logger.enable"), "YES", "NO", true)) {
        log.setLevel("SILENT");
        return;
    }
    const std::string level = coil::toUpper(config.getProperty("logger.log_level"));
    log.setLevel(level == "NORMAL" || level.empty() ? "INFO" : level.c_str()); // NORMAL: INFO of 1.x
    if (!config.getProperty("logger.date_format").empty())
        log.setDateFormat(config.getProperty("logger.date_format").c_str());
    coil::Properties self;
    self.setProperty("instance_name", config.getProperty("manager.instance_name"));
    for (const auto& format : coil::split(config.getProperty("logger.file_name"), ",", true)) {
        const std::string name = format_name(format, self, config);
        if (!Logger::addOutput(name)) throw ManagerError("logger.file_name: cannot write to " + name);
    }
}

// Called before the process has other threads, because threads inherit the affinity of their creator.
void pin_process(const std::string& processors, Logger& rtclog) {
    std::vector<int> cpus;
    if (processors.empty() || !coil::stringTo(cpus, processors.c_str())) return;
    if (const auto notice = tandem::rt::pin_this_thread("manager", cpus)) RTC_WARN(("%s", notice->c_str()));
}

// In OpenRTM-aist these policies ask name servers or other managers. Tandem does not.
void warn_about_naming_policy(const coil::Properties& config, SettingOrigins& origins) {
    const char* const key = "manager.components.naming_policy";
    const std::string policy = coil::normalize(config.getProperty(key));
    if (policy == "ns_unique" || policy == "node_unique")
        warn_about_setting("manager", origins[key] + ": " + key + " " + policy +
                                          ": names are made unique within this process only");
}

// Returns the file that was read; "": none.
std::string read_settings(std::vector<std::string> arguments, coil::Properties& config,
                          SettingOrigins& origins) {
    for (const auto& [key, value] : default_settings) config.setDefault(key, value);
    return read_manager_settings(start_of_this_process(std::move(arguments)), config, origins);
}

} // namespace

ManagerConfig::ManagerConfig(int argc, char** argv) { init(argc, argv); }

ManagerConfig::~ManagerConfig() = default;

void ManagerConfig::init(int argc, char** argv) { m_arguments.assign(argv, argv + argc); }

void ManagerConfig::configure(coil::Properties& prop) {
    SettingOrigins ignored;
    read_settings(m_arguments, prop, ignored);
    describe_system(prop);
}

void configure_process(Manager::Impl& impl, int argc, char** argv) {
    SettingOrigins origins;
    impl.conf_file = read_settings({argv, argv + argc}, impl.config, origins);
    // Errors are thrown before the log is open; warnings wait for it.
    const auto warnings = check_and_normalize_settings(impl.config, origins);
    describe_system(impl.config);
    impl.config.setProperty("manager.pid", std::to_string(getpid()));
    set_up_logger(impl.config, impl.log);
    Logger& rtclog = impl.log;
    for (const auto& warning : warnings) warn_about_setting("manager", warning);
    if (const std::string unused = settings_without_effect(origins); !unused.empty())
        RTC_INFO(("%s", unused.c_str()));
    warn_about_naming_policy(impl.config, origins);
    pin_process(impl.config.getProperty("manager.cpu_affinity"), rtclog);
}

} // namespace RTC
