// SPDX-License-Identifier: Apache-2.0
// The table of rtc.conf keys. OpenRTM-aist spreads the same keys over DefaultConfiguration.h, the reads of
// Manager.cpp and the sample rtc.conf. A test compares the rows that are not used with DIFFERENCES.md.
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include <coil/stringutil.h>

namespace RTC {

const std::vector<ConfKey>& conf_keys() {
    using K = ConfKey;
    static const std::vector<ConfKey> keys{
        // Facts about the program that OpenRTM-aist keeps among its settings.
        {"config.version", K::text, false},
        {"openrtm.name", K::text, false},
        {"openrtm.version", K::text, false},
        {"os.*", K::text, false},
        {"module.conf_path", K::text, false},
        {"module.load_path", K::text, false},
        // The manager itself: its names, its remote interface, when it ends.
        {"manager.name", K::text, true},
        {"manager.instance_name", K::text, true},
        {"manager.naming_formats", K::text, true},
        {"manager.pid", K::text, false},
        {"manager.is_master", K::yes_no, true},
        {"manager.corba_servant", K::yes_no, true},
        {"manager.shutdown_on_nortcs", K::yes_no, true},
        {"manager.shutdown_auto", K::yes_no, true},
        {"manager.auto_shutdown_duration", K::seconds, true},
        {"manager.termination_waittime", K::seconds, false},
        {"manager.peer_check_interval", K::seconds, true},
        {"manager.service_call_timeout", K::seconds, true},
        {"manager.cpu_affinity", K::cpu_list, true},
        {"manager.remote_shutdown", K::yes_no, true},
        {"manager.command", K::text, false},
        {"manager.nameservers", K::text, false},
        {"manager.language", K::text, false},
        {"manager.supported_languages", K::text, false},
        // What the manager loads, creates, connects and activates when it starts.
        {"manager.preload.modules", K::text, true},
        {"manager.components.precreate", K::text, true},
        {"manager.components.preconnect", K::text, true},
        {"manager.components.preactivation", K::text, true},
        {"manager.components.naming_policy", K::naming_policy, true},
        {"manager.modules.load_path", K::text, true},
        {"manager.modules.C++.load_paths", K::text, true},
        {"manager.modules.preload", K::text, true},
        {"manager.modules.abs_path_allowed", K::yes_no, true},
        {"manager.modules.search_auto", K::yes_no, true},
        {"manager.modules.remote_load", K::yes_no, true},
        {"manager.modules.init_func_prefix", K::text, false},
        {"manager.modules.init_func_suffix", K::text, false},
        {"manager.modules.config_ext", K::text, false},
        {"manager.modules.config_path", K::text, false},
        {"manager.modules.detect_loadable", K::yes_no, false},
        {"manager.modules.download_allowed", K::yes_no, false},
        {"manager.modules.download_cleanup", K::yes_no, false},
        {"manager.modules.download_dir", K::text, false},
        {"manager.modules.*.manager_cmd", K::text, false},
        {"manager.modules.*.profile_cmd", K::text, false},
        {"manager.modules.*.suffixes", K::text, false},
        {"manager.modules.*.load_path", K::text, false},
        {"manager.modules.*.load_paths", K::text, false},
        {"manager.modules.Docker.**", K::text, false},
        // Services and masters of a distributed system of managers.
        {"manager.local_service.**", K::text, false},
        {"manager.update_master_manager.enable", K::yes_no, false},
        {"manager.update_master_manager.interval", K::seconds, false},
        // Log level, files, and streams that libraries bring along.
        {"logger.enable", K::yes_no, true},
        {"logger.file_name", K::text, true},
        {"logger.date_format", K::text, true},
        {"logger.log_level", K::log_level, true},
        {"logger.clock_type", K::text, false},
        {"logger.escape_sequence_enable", K::yes_no, false},
        {"logger.stream_lock", K::text, false},
        {"logger.master_logger", K::text, false},
        {"logger.plugins", K::text, false},
        {"logger.logstream.**", K::text, true},
        {"logging.**", K::text, false},
        // Names of components in CORBA name servers.
        {"naming.enable", K::yes_no, true},
        {"naming.type", K::text, false},
        {"naming.formats", K::text, true},
        {"naming.names", K::text, true},
        {"naming.update.enable", K::yes_no, true},
        {"naming.update.interval", K::seconds, true},
        {"naming.update.rebind", K::yes_no, true},
        // OpenRTM-aist's polling timer.
        {"timer.enable", K::yes_no, false},
        {"timer.tick", K::seconds, false},
        // The ORB.
        {"corba.args", K::text, true},
        {"corba.id", K::text, false},
        {"corba.endpoint", K::text, true},
        {"corba.endpoints", K::text, true},
        {"corba.permitted_users", K::text, true},
        {"corba.permitted_hosts", K::text, true},
        {"corba.max_connections", K::integer, true},
        {"corba.request_timeout", K::seconds, true},
        {"corba.endpoints_ipv4", K::text, false},
        {"corba.endpoints_ipv6", K::text, false},
        {"corba.endpoint_property", K::text, false},
        {"corba.alternate_iiop_addresses", K::text, false},
        {"corba.additional_ior_addresses", K::text, false},
        {"corba.nameservers", K::text, true},
        {"corba.nameservice.replace_endpoint", K::yes_no, false},
        {"corba.master_manager", K::text, true},
        {"corba.update_master_manager.enable", K::yes_no, false},
        {"corba.update_master_manager.interval", K::seconds, false},
        {"corba.ssl.certificate_authority_file", K::text, true},
        {"corba.ssl.key_file", K::text, true},
        {"corba.ssl.key_file_password", K::text, true},
        {"corba.ssl.**", K::text, false},
        {"corba.http.**", K::text, false},
        // Execution contexts: defaults for all, then `ec.TYPE.*` and `ec.NAME.*`.
        {"exec_cxt.periodic.type", K::text, true},
        {"exec_cxt.periodic.rate", K::hertz, true},
        {"exec_cxt.periodic.phase", K::milliseconds, true},
        {"exec_cxt.periodic.name", K::text, true},
        {"exec_cxt.periodic.sync_transition", K::yes_no, true},
        {"exec_cxt.periodic.sync_activation", K::yes_no, true},
        {"exec_cxt.periodic.sync_deactivation", K::yes_no, true},
        {"exec_cxt.periodic.sync_reset", K::yes_no, true},
        {"exec_cxt.periodic.transition_timeout", K::seconds, true},
        {"exec_cxt.periodic.activation_timeout", K::seconds, true},
        {"exec_cxt.periodic.deactivation_timeout", K::seconds, true},
        {"exec_cxt.periodic.reset_timeout", K::seconds, true},
        {"exec_cxt.periodic.cpu_affinity", K::cpu_list, true},
        {"exec_cxt.periodic.priority", K::integer, true},
        {"exec_cxt.event_driven_type", K::text, false},
        {"exec_cxt.event_driven.type", K::text, false},
        {"exec_cxt.sync_transition", K::yes_no, true},
        {"exec_cxt.sync_activation", K::yes_no, true},
        {"exec_cxt.sync_deactivation", K::yes_no, true},
        {"exec_cxt.sync_reset", K::yes_no, true},
        {"exec_cxt.transition_timeout", K::seconds, true},
        {"exec_cxt.activation_timeout", K::seconds, true},
        {"exec_cxt.deactivation_timeout", K::seconds, true},
        {"exec_cxt.reset_timeout", K::seconds, true},
        {"exec_cxt.cpu_affinity", K::cpu_list, true},
        {"exec_cxt.priority", K::integer, true},
        {"exec_cxt.stack_size", K::integer, false},
        {"exec_cxt.interrupt", K::text, false},
        {"ec.*.rate", K::hertz, true},
        {"ec.*.phase", K::milliseconds, true},
        {"ec.*.name", K::text, true},
        {"ec.*.sync_transition", K::yes_no, true},
        {"ec.*.sync_activation", K::yes_no, true},
        {"ec.*.sync_deactivation", K::yes_no, true},
        {"ec.*.sync_reset", K::yes_no, true},
        {"ec.*.transition_timeout", K::seconds, true},
        {"ec.*.activation_timeout", K::seconds, true},
        {"ec.*.deactivation_timeout", K::seconds, true},
        {"ec.*.reset_timeout", K::seconds, true},
        {"ec.*.cpu_affinity", K::cpu_list, true},
        {"ec.*.priority", K::integer, true},
        {"ec.**", K::text, true}, // of contexts that libraries bring
        // Defaults for ports, by direction and name; a transport or a buffer of a library may have others.
        {"port.*.*.allow_dup_connection", K::yes_no, true},
        {"port.*.*.buffer.length", K::integer, true},
        {"port.*.*.buffer.read.empty_policy", K::text, true},
        {"port.*.*.buffer.read.timeout", K::text, true},
        {"port.*.*.buffer.write.full_policy", K::text, true},
        {"port.*.*.buffer.write.timeout", K::text, true},
        {"port.*.*.buffer_type", K::text, true},
        {"port.*.*.connection_limit", K::integer, true},
        {"port.*.*.consumer_types", K::text, true},
        {"port.*.*.dataflow_type", K::text, true},
        {"port.*.*.interface_type", K::text, true},
        {"port.*.*.marshaling_type", K::text, true},
        {"port.*.*.publisher.push_policy", K::text, true},
        {"port.*.*.publisher.push_rate", K::text, true},
        {"port.*.*.publisher.skip_count", K::text, true},
        {"port.*.*.push_policy", K::text, true},
        {"port.*.*.push_rate", K::text, true},
        {"port.*.*.provider_types", K::text, true},
        {"port.*.*.publish_topic", K::text, true},
        {"port.*.*.rendezvous_point", K::text, true},
        {"port.*.*.serializer.cdr.endian", K::text, true},
        {"port.*.*.skip_count", K::text, true},
        {"port.*.*.subscribe_topic", K::text, true},
        {"port.*.*.subscription_type", K::text, true},
        {"port.*.*.timestamp_policy", K::text, true},
        {"port.**", K::text, true},
        // SDO services of a component.
        {"sdo.service.provider.available_services", K::text, false},
        {"sdo.service.provider.enabled_services", K::text, true},
        {"sdo.service.provider.providing_services", K::text, false},
        {"sdo.service.consumer.available_services", K::text, false},
        {"sdo.service.consumer.enabled_services", K::text, true},
        // A transport that is not here.
        {"opensplice.**", K::text, false},
    };
    return keys;
}

namespace {

bool matches(const coil::vstring& pattern, const coil::vstring& key) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == "**") return key.size() > i;
        if (i >= key.size() || (pattern[i] != "*" && pattern[i] != key[i])) return false;
    }
    return pattern.size() == key.size();
}

} // namespace

// The first match counts, so a row with a pattern comes after the rows that it also matches.
const ConfKey* find_conf_key(const std::string& key) {
    const auto parts = coil::split(key, ".");
    for (const auto& known : conf_keys())
        if (matches(coil::split(known.name, "."), parts)) return &known;
    return nullptr;
}

} // namespace RTC
