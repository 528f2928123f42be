// SPDX-License-Identifier: Apache-2.0
// Unknown keys get a warning with the nearest known key; values of the wrong kind are errors.
#include "host/rtm/runtime/configuration/conf_check.hpp"

#include "host/process/published/notices.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/conf_keys.hpp"
#include "host/text/nearest_name.hpp"
#include "host/text/parse_number.hpp"

#include <algorithm>
#include <cmath>
#include <coil/stringutil.h>
#include <optional>
#include <rtm/ExecutionContextBase.h>
#include <rtm/Manager.h>
#include <rtm/SystemLogger.h>

namespace RTC {
namespace {

// The known keys without patterns.
std::vector<std::string> plain_keys() {
    std::vector<std::string> names;
    for (const auto& known : conf_keys())
        if (std::string(known.name).find('*') == std::string::npos) names.emplace_back(known.name);
    return names;
}

// Returns whether `name` is the first part of a known key.
bool is_section(const std::string& name) {
    return std::any_of(conf_keys().begin(), conf_keys().end(), [&](const ConfKey& known) {
        return std::string(known.name).compare(0, name.size() + 1, name + ".") == 0;
    });
}

const std::vector<std::string> own_context_types{"PeriodicExecutionContext", "ExtTrigExecutionContext",
                                                 "SynchExtTriggerEC", "OpenHRPExecutionContext"};

// Returns the names X of the rows that begin with `start`, for example `ec.*.X`.
std::vector<std::string> options_below(const std::string& start) {
    std::vector<std::string> names;
    for (const auto& known : conf_keys())
        if (const std::string name = known.name; name.starts_with(start))
            names.push_back(name.substr(start.size()));
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Returns `type` if it may be the name of a context or a library's type. Otherwise returns Tandem's most similar type.
std::string meant_context_type(const std::string& type) {
    const auto is_prefix = [&](const std::string& own) { return type.starts_with(own); };
    if (std::any_of(own_context_types.begin(), own_context_types.end(), is_prefix)) return type;
    const bool is_misspelt = !tandem::text::did_you_mean(type, own_context_types).empty();
    return is_misspelt ? tandem::text::nearest_name(type, own_context_types) : type;
}

// Returns the key that was probably meant by a key below `ec.`; empty if the key is valid. `ec.NAME.OPTION` configures
// the context of that name. A library's type may have additional options, so an unknown option is valid there unless it
// resembles a known one.
std::string meant_context_key(const coil::vstring& parts) {
    const std::string type = parts.size() > 2 ? parts[1] : own_context_types[0];
    const std::string option =
        coil::flatten(coil::vstring(parts.begin() + (parts.size() > 2 ? 2 : 1), parts.end()), ".");
    const auto options = options_below("ec.*.");
    const std::string meant_type = meant_context_type(type);
    std::string meant = option;
    if (!contains(options, option) &&
        (contains(own_context_types, meant_type) || !tandem::text::did_you_mean(option, options).empty()))
        meant = tandem::text::nearest_name(option, options);
    const bool is_right = parts.size() > 2 && meant_type == type && meant == option;
    return is_right ? "" : "ec." + meant_type + "." + meant;
}

const std::vector<std::string> port_kinds{"inport", "outport", "corbaport", "corba"};

// Returns the key that was probably meant by a key below `port.`, which is `port.KIND.NAME.OPTION` or
// `port.corba.OPTION`; empty if the key is valid. A name may have dots, and an option that resembles no known one
// belongs to a library.
std::string meant_port_key(const coil::vstring& parts) {
    const auto text_from = [&](std::size_t first) {
        return coil::flatten(coil::vstring(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end()),
                             ".");
    };
    const auto options = options_below("port.*.*.");
    const std::string& kind = parts[1];
    if (!contains(port_kinds, kind)) {
        if (tandem::text::did_you_mean(kind, port_kinds).empty()) return "";
        return "port." + tandem::text::nearest_name(kind, port_kinds) + "." + text_from(2);
    }
    if (kind != "corba" && contains(options, text_from(2)))
        return "port." + kind + (kind == "corbaport" ? ".NAME." : ".dataport.") + text_from(2);
    const std::size_t first = kind == "corba" ? 2 : 3;
    for (std::size_t i = first; i < parts.size(); ++i)
        if (contains(options, text_from(i))) return "";
    std::string meant;
    std::size_t least = std::string::npos;
    for (std::size_t i = first; i < parts.size(); ++i) {
        const std::string option = text_from(i), nearest = tandem::text::nearest_name(option, options);
        const std::size_t distance = tandem::text::edit_distance(option, nearest);
        if (tandem::text::did_you_mean(option, options).empty() || distance >= least) continue;
        const coil::vstring before(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i));
        meant = coil::flatten(before, ".") + "." + nearest;
        least = distance;
    }
    return meant;
}

// A key CATEGORY.TYPE.KEY or CATEGORY.INSTANCE.KEY configures a component, and only the component knows its keys. Such
// a key is valid unless it resembles a known key so closely that a typing error is likely.
std::optional<std::string> unknown_key_warning(const std::string& key) {
    constexpr std::size_t max_compared = 100; // the comparison takes time with the key's length
    constexpr std::size_t likely_typing_error = 2;
    const auto parts = coil::split(key, ".");
    if (parts[0] == "ec" && parts.size() > 1 && key.size() <= max_compared) {
        const std::string meant = meant_context_key(parts);
        if (!meant.empty()) return "unknown key " + printable(key) + "; did you mean " + meant + "?";
    }
    if (parts[0] == "port" && parts.size() > 2 && key.size() <= max_compared) {
        const std::string meant = meant_port_key(parts);
        if (!meant.empty()) return "unknown key " + printable(key) + "; did you mean " + meant + "?";
    }
    if (find_conf_key(key) != nullptr) return std::nullopt;
    const std::string start = key.substr(0, max_compared);
    const std::string nearest = tandem::text::nearest_name(start, plain_keys());
    if (parts.size() >= 3 && !is_section(parts[0]) &&
        tandem::text::edit_distance(start, nearest) > likely_typing_error)
        return std::nullopt;
    return "unknown key " + printable(key) + "; did you mean " + nearest + "?";
}

bool is_cpu_list(const std::string& list) {
    const auto parts = coil::split(list, ",", true);
    return std::all_of(parts.begin(), parts.end(), [](const std::string& cpu) {
        return cpu.find_first_not_of("0123456789") == std::string::npos && cpu.size() < 6;
    });
}

// Checks a value and rewrites the words of a boolean to YES or NO. Returns the expected value for a message; empty if
// the value is valid.
std::string check_value(ConfKey::Value kind, std::string& value) {
    const std::string word = coil::normalize(value);
    const auto parsed = tandem::text::parse_number(value);
    const bool numeric = parsed.has_value();
    const double number = parsed.value_or(-1);
    auto is_one_of = [&](std::initializer_list<const char*> words) {
        return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
    };
    switch (kind) {
    case ConfKey::yes_no:
        if (is_one_of({"yes", "true", "on", "1", "enable"})) {
            value = "YES";
            return "";
        }
        if (is_one_of({"no", "false", "off", "0", "disable"})) {
            value = "NO";
            return "";
        }
        return "YES or NO";
    case ConfKey::seconds:
        return numeric && number >= 0 && number <= 1e9 ? "" : "seconds, 0 to 1e9";
    case ConfKey::hertz:
        return numeric && ExecutionContextBase::isRate(number) ? "" : "a rate in Hz above 0, at most 1e9";
    case ConfKey::milliseconds:
        return numeric && std::abs(number) <= 1e9 ? "" : "milliseconds, -1e9 to 1e9";
    case ConfKey::integer:
        return numeric && std::abs(number) < 1e9 && number == std::trunc(number) ? "" : "an integer";
    case ConfKey::cpu_list:
        return is_cpu_list(value) ? "" : "processor numbers separated by commas, for example 0, 1";
    case ConfKey::log_level:
        return is_one_of({"silent", "fatal", "error", "warn", "info", "normal", "debug", "trace", "verbose",
                          "paranoid"})
                   ? ""
                   : "SILENT, FATAL, ERROR, WARN, INFO, DEBUG, TRACE, VERBOSE or PARANOID";
    case ConfKey::naming_policy:
        return is_one_of({"process_unique", "default", "ns_unique", "node_unique"})
                   ? ""
                   : "process_unique, ns_unique or node_unique";
    case ConfKey::text:
        break;
    }
    return "";
}

} // namespace

void warn_about_setting(const std::string& name, const std::string& line) {
    Logger(name.c_str()).write(Logger::RTL_WARN, line);
    tandem::process::publish_notice(tandem::process::NoticeKind::setting, name + ": " + line);
}

bool check_and_normalize_value(const std::string& key, std::string& value) {
    const ConfKey* known = find_conf_key(key);
    return known == nullptr || value.empty() || check_value(known->value, value).empty();
}

std::string setting_error(const std::string& key, std::string value) {
    if (const auto warning = unknown_key_warning(key)) return *warning;
    const ConfKey* known = find_conf_key(key);
    const std::string expected = known == nullptr || value.empty() ? "" : check_value(known->value, value);
    return expected.empty() ? "" : key + " is " + printable(value) + ", expected " + expected;
}

// A transport or a buffer of a library may have other properties.
std::string connector_property_error(const std::string& key, std::string value) {
    std::string option = key, found = key;
    auto known = options_below("port.*.*.");
    if (key.starts_with("port.")) {
        known = {"port.connection.strictness", "port.allow_dup_connection"};
    } else {
        for (const std::string start : {"dataport.", "inport.", "outport."}) // of one direction
            if (option.starts_with(start)) option.erase(0, start.size());
        found = key.starts_with("dataport.") ? key.substr(9) : key;
    }
    if (!contains(known, option)) {
        const std::string meant = tandem::text::did_you_mean(option, known);
        return meant.empty() ? "" : "unknown key " + printable(found) + meant;
    }
    const ConfKey* row = find_conf_key("port.outport.dataport." + option);
    const std::string expected = row == nullptr || value.empty() ? "" : check_value(row->value, value);
    return expected.empty() ? "" : found + " is " + printable(value) + ", expected " + expected;
}

std::string settings_without_effect(const SettingOrigins& origins) {
    coil::vstring unused;
    for (const auto& [key, origin] : origins)
        if (const ConfKey* known = find_conf_key(key); known != nullptr && !known->used)
            unused.push_back(printable(key) + " (" + origin + ")");
    return unused.empty() ? ""
                          : "accepted without effect: " + coil::flatten(unused) +
                                "; DIFFERENCES.md of rtm_host says why";
}

std::vector<std::string> check_and_normalize_settings(coil::Properties& config,
                                                      const SettingOrigins& origins) {
    std::vector<std::string> warnings;
    for (const auto& [key, origin] : origins) {
        if (const auto warning = unknown_key_warning(key)) warnings.push_back(origin + ": " + *warning);
        const ConfKey* known = find_conf_key(key);
        std::string value = config.getProperty(key);
        // An empty value means that the key is not set, as in OpenRTM-aist.
        if (known == nullptr || value.empty()) continue;
        const std::string expected = check_value(known->value, value);
        if (!expected.empty())
            throw ManagerError(origin + ": " + key + " is " + printable(value) + ", expected " + expected);
        config.setProperty(key, value);
    }
    return warnings;
}

} // namespace RTC
