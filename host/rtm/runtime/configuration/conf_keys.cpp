// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include <algorithm>
#include <cmath>
#include <coil/stringutil.h>
#include <cstdlib>
#include <optional>
#include <rtm/ExecutionContextBase.h>
#include <rtm/Manager.h>
#include <utility>

namespace RTC {

const std::vector<ConfKey>& conf_keys() {
    using K = ConfKey;
    static const std::vector<ConfKey> keys{
        {"config.version", K::text, false},
        {"openrtm.name", K::text, false},
        {"openrtm.version", K::text, false},
        {"os.*", K::text, false},
        {"module.conf_path", K::text, false},
        {"module.load_path", K::text, false},
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
        {"manager.cpu_affinity", K::processors, true},
        {"manager.command", K::text, false},
        {"manager.nameservers", K::text, false},
        {"manager.language", K::text, false},
        {"manager.supported_languages", K::text, false},
        {"manager.preload.modules", K::text, true},
        {"manager.components.precreate", K::text, true},
        {"manager.components.preconnect", K::text, true},
        {"manager.components.preactivation", K::text, true},
        {"manager.components.naming_policy", K::policy, true},
        {"manager.modules.load_path", K::text, true},
        {"manager.modules.preload", K::text, true},
        {"manager.modules.abs_path_allowed", K::yes_no, true},
        {"manager.modules.search_auto", K::yes_no, true},
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
        {"manager.local_service.**", K::text, false},
        {"manager.update_master_manager.enable", K::yes_no, false},
        {"manager.update_master_manager.interval", K::seconds, false},
        {"logger.enable", K::yes_no, true},
        {"logger.file_name", K::text, true},
        {"logger.date_format", K::text, true},
        {"logger.log_level", K::level, true},
        {"logger.clock_type", K::text, false},
        {"logger.escape_sequence_enable", K::yes_no, false},
        {"logger.stream_lock", K::text, false},
        {"logger.master_logger", K::text, false},
        {"logger.plugins", K::text, false},
        {"logger.logstream.**", K::text, true},
        {"logging.**", K::text, false},
        {"naming.enable", K::yes_no, true},
        {"naming.type", K::text, false},
        {"naming.formats", K::text, true},
        {"naming.names", K::text, true},
        {"naming.update.enable", K::yes_no, true},
        {"naming.update.interval", K::seconds, true},
        {"naming.update.rebind", K::yes_no, true},
        {"timer.enable", K::yes_no, false},
        {"timer.tick", K::seconds, false},
        {"corba.args", K::text, true},
        {"corba.id", K::text, false},
        {"corba.endpoint", K::text, true},
        {"corba.endpoints", K::text, true},
        {"corba.endpoints_ipv4", K::text, false},
        {"corba.endpoints_ipv6", K::text, false},
        {"corba.endpoint_property", K::text, false},
        {"corba.alternate_iiop_addresses", K::text, false},
        {"corba.nameservers", K::text, true},
        {"corba.nameservice.replace_endpoint", K::yes_no, false},
        {"corba.master_manager", K::text, false},
        {"corba.update_master_manager.enable", K::yes_no, false},
        {"corba.update_master_manager.interval", K::seconds, false},
        {"corba.ssl.**", K::text, false},
        {"corba.http.**", K::text, false},
        {"exec_cxt.periodic.type", K::text, true},
        {"exec_cxt.periodic.rate", K::hertz, true},
        {"exec_cxt.periodic.phase", K::text, true},
        {"exec_cxt.periodic.**", K::text, true},
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
        {"exec_cxt.cpu_affinity", K::processors, true},
        {"exec_cxt.priority", K::whole, true},
        {"exec_cxt.stack_size", K::whole, false},
        {"exec_cxt.interrupt", K::text, false},
        {"ec.**", K::text, true},
        {"port.**", K::text, true},
        {"sdo.service.provider.available_services", K::text, false},
        {"sdo.service.provider.enabled_services", K::text, true},
        {"sdo.service.provider.providing_services", K::text, false},
        {"sdo.service.consumer.available_services", K::text, false},
        {"sdo.service.consumer.enabled_services", K::text, true},
        {"opensplice.**", K::text, false},
    };
    return keys;
}

namespace {

bool fits(const coil::vstring& pattern, const coil::vstring& key) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (pattern[i] == "**") return key.size() > i;
        if (i >= key.size() || (pattern[i] != "*" && pattern[i] != key[i])) return false;
    }
    return pattern.size() == key.size();
}

// How many letters have to be put in, taken out or changed.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, changed}));
        }
    }
    return row.back();
}

struct Nearest {
    std::string name;
    std::size_t distance = static_cast<std::size_t>(-1);
};

Nearest nearest(const std::string& key) {
    Nearest best;
    for (const auto& known : conf_keys()) {
        if (std::string(known.name).find('*') != std::string::npos) continue;
        const std::size_t d = distance(key, known.name);
        if (d < best.distance) best = {known.name, d};
    }
    return best;
}

bool is_section(const std::string& name) {
    return std::any_of(conf_keys().begin(), conf_keys().end(), [&](const ConfKey& known) {
        return std::string(known.name).compare(0, name.size() + 1, name + ".") == 0;
    });
}

// <category>.<type or instance name>.<key> is a component's, and only it knows which keys it has.
std::optional<std::string> complaint(const std::string& key) {
    if (find_conf_key(key) != nullptr) return std::nullopt;
    const auto parts = coil::split(key, ".");
    const Nearest near = nearest(key.substr(0, 100));
    if (parts.size() >= 3 && !is_section(parts[0]) && near.distance > 2) return std::nullopt;
    return "there is no key " + printable(key) + "; did you mean " + near.name + "?";
}

bool is_number(const std::string& text, double& number) {
    char* end = nullptr;
    number = std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == '\0';
}

bool are_processors(const std::string& list) {
    const auto parts = coil::split(list, ",", true);
    return std::all_of(parts.begin(), parts.end(), [](const std::string& one) {
        return one.find_first_not_of("0123456789") == std::string::npos && one.size() < 6;
    });
}

// What a value should be; empty when it is that.
std::string expectation(ConfKey::Value kind, std::string& value) {
    const std::string word = coil::normalize(value);
    double number = -1;
    const bool numeric = is_number(value, number);
    auto is_one_of = [&](std::initializer_list<const char*> words) {
        return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
    };
    switch (kind) {
    case ConfKey::yes_no:
        if (is_one_of({"yes", "true", "on", "1", "enable"})) return value = "YES", "";
        if (is_one_of({"no", "false", "off", "0", "disable"})) return value = "NO", "";
        return "YES or NO";
    case ConfKey::seconds:
        return numeric && number >= 0 && number <= 1e9 ? "" : "seconds, 1e9 at most";
    case ConfKey::hertz:
        return numeric && ExecutionContextBase::isRate(number) ? "" : "a rate in Hz above 0, 1e9 at most";
    case ConfKey::whole:
        return numeric && std::abs(number) < 1e9 && number == std::trunc(number) ? "" : "a whole number";
    case ConfKey::processors:
        return are_processors(value) ? "" : "numbers of processors, as 0, 1";
    case ConfKey::level:
        return is_one_of({"silent", "fatal", "error", "warn", "info", "normal", "debug", "trace", "verbose",
                          "paranoid"})
                   ? ""
                   : "SILENT, FATAL, ERROR, WARN, INFO, DEBUG, TRACE, VERBOSE or PARANOID";
    case ConfKey::policy:
        return is_one_of({"process_unique", "default", "ns_unique", "node_unique"})
                   ? ""
                   : "process_unique, ns_unique or node_unique";
    case ConfKey::text:
        break;
    }
    return "";
}

} // namespace

const ConfKey* find_conf_key(const std::string& key) {
    const auto parts = coil::split(key, ".");
    for (const auto& known : conf_keys())
        if (fits(coil::split(known.name, "."), parts)) return &known;
    return nullptr;
}

bool normalize_value(const std::string& key, std::string& value) {
    const ConfKey* known = find_conf_key(key);
    return known == nullptr || value.empty() || expectation(known->value, value).empty();
}

std::vector<std::string> check_settings(coil::Properties& config, const SettingOrigins& places) {
    std::vector<std::string> unknown;
    for (const auto& [key, place] : places) {
        if (const auto line = complaint(key)) unknown.push_back(place + ": " + *line);
        const ConfKey* known = find_conf_key(key);
        std::string value = config.getProperty(key);
        if (known == nullptr || value.empty()) continue; // empty: as if it were not there
        const std::string expected = expectation(known->value, value);
        if (!expected.empty())
            throw ManagerError(place + ": " + key + " is " + printable(value) + ", expected " + expected);
        config.setProperty(key, value);
    }
    return unknown;
}

} // namespace RTC
