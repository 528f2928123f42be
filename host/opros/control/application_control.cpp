// SPDX-License-Identifier: Apache-2.0
#include "host/opros/control/application_control.hpp"

#include "host/crash/callback_scope.hpp"
#include "host/opros/control/describe_port.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/text/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace tandem::control {
namespace {

using engine::ComponentHost;
using nlohmann::json;

constexpr double default_limit_s = 5, min_limit_s = 0.1, max_limit_s = 600;
constexpr double shortest_shown_s = 0.1; // of a callback

const char* state_name(LifecycleState state) {
    static const char* const names[] = {"CREATED", "READY", "ACTIVE", "INACTIVE", "ERROR", "DESTROYED"};
    return names[state];
}

/// Returns for example "onStart has taken 1.3 s so far", or an empty text.
std::string running_callback(const ComponentHost& component) {
    const auto running = crash::find_running_callback(&component);
    if (!running || running->seconds() < shortest_shown_s) return "";
    return fmt::format("{} has taken {:.1f} s so far", running->name, running->seconds());
}

/// An aperiodic component has no period.
json period_ms(const engine::ComponentProfile& profile) {
    return profile.period.count() == 0 ? json() : json(static_cast<double>(profile.period.count()) / 1e6);
}

json describe(ComponentHost& component) {
    return {{"name", component.name()},
            {"type", component.profile().name},
            {"state", state_name(component.component().getStatus())},
            {"callback", running_callback(component)},
            {"executor", name_of(component.profile().execution_type)},
            {"period_ms", period_ms(component.profile())}};
}

/// The text differs from the line in the log if the component went to ERROR without notifying the engine, as AdaptorComp does.
std::string error_of(ComponentHost& component) {
    if (component.component().getStatus() != OPROS_CS_ERROR) return "";
    const std::string error = component.last_error();
    return error.empty() ? "it has gone to ERROR by itself; the log of its host says why" : error;
}

/// Returns null if the request is not a JSON object.
json parse(const std::string& request) {
    json parsed = json::parse(request, nullptr, false);
    return parsed.is_object() ? parsed : json();
}

std::string text_of(const json& request, const char* name) {
    const auto found = request.find(name);
    return found != request.end() && found->is_string() ? found->get<std::string>() : "";
}

double limit_s(const json& request) {
    const auto found = request.find("timeout_s");
    const double asked =
        found != request.end() && found->is_number() ? found->get<double>() : default_limit_s;
    return std::clamp(asked, min_limit_s, max_limit_s);
}

// Values of properties may be in any encoding.
std::string dump(const json& reply) { return reply.dump(-1, ' ', false, json::error_handler_t::replace); }

} // namespace

ApplicationControl::ApplicationControl(engine::Application& application, const std::string& profile)
    : application_(application), connections_(application.connections()),
      profile_(std::filesystem::absolute(profile).lexically_normal().string()) {
    for (const auto& component : application_.components())
        ports_.emplace(component->name(), std::make_unique<PortList>(*component));
}

std::string ApplicationControl::answer(const std::string& request) {
    try {
        return dump(execute(parse(request)));
    } catch (const std::exception& error) {
        return dump({{"error", error.what()}});
    }
}

std::chrono::milliseconds ApplicationControl::time_limit(const std::string& request) {
    return std::chrono::milliseconds(static_cast<long>(1000 * limit_s(parse(request))));
}

bool ApplicationControl::runs_callback(const std::string& request) {
    const std::string command = text_of(parse(request), "command");
    return command != "list" && command != "info";
}

std::string ApplicationControl::late_reply(const std::string& request) {
    const json parsed = parse(request);
    const std::string name = text_of(parsed, "component"), command = text_of(parsed, "command");
    const ComponentHost* component = application_.find_component(name);
    const std::string callback = component != nullptr ? running_callback(*component) : "";
    return dump(
        {{"error",
          fmt::format("component {}: {} has not ended within {} s{}; the host continues with it. If the "
                      "component is slow, allow more time with --timeout; otherwise it hangs",
                      name, command, limit_s(parsed), callback.empty() ? "" : ": " + callback)}});
}

json ApplicationControl::execute(const json& request) {
    const std::string command = text_of(request, "command");
    if (command == "list") return list();
    if (command == "info") return info(find(request));
    if (command == "conf") return configure(find(request), request);
    if (command == "start" || command == "stop" || command == "recover")
        return make_transition(find(request), command);
    throw std::runtime_error(fmt::format(
        "opros_host {} does not know the command '{}'; use the tandem of its version", getpid(), command));
}

ComponentHost& ApplicationControl::find(const json& request) {
    const std::string name = text_of(request, "component");
    if (ComponentHost* component = application_.find_component(name)) return *component;
    std::vector<std::string> known;
    for (const auto& component : application_.components()) known.push_back(component->name());
    throw std::runtime_error(fmt::format("opros_host {} has no component {}{} (it has: {})", getpid(), name,
                                         text::did_you_mean(name, known), fmt::join(known, ", ")));
}

json ApplicationControl::list() {
    json components = json::array();
    for (const auto& component : application_.components()) components.push_back(describe(*component));
    return {{"pid", getpid()},
            {"application", std::filesystem::path(profile_).stem().string()},
            {"profile", profile_},
            {"components", std::move(components)}};
}

json ApplicationControl::info(ComponentHost& component) {
    json out = describe(component);
    out["pid"] = getpid();
    out["last_error"] = error_of(component);
    out["profile"] = component.profile().location.file.string();
    out["library"] = component.profile().library_name;
    out["priority"] = component.profile().priority;
    out["phase_ms"] = static_cast<double>(component.profile().phase.count()) / 1e6;
    out["ports"] = ports_.at(component.name())->describe();
    out["connections"] = json::array();
    for (const auto& each : connections_.statuses())
        if (each.source.component == component.name() || each.target.component == component.name())
            out["connections"].push_back({{"kind", kind_name(each.type)},
                                          {"from", each.source.text()},
                                          {"to", each.target.text()},
                                          {"problem", each.problem}});
    out["properties"] = read_properties(component);
    return out;
}

void ApplicationControl::close() {
    const std::lock_guard lock(properties_mutex_);
    closed_ = true;
}

/// Returns null if the component's cycle does not end.
json ApplicationControl::read_properties(ComponentHost& component) {
    const std::lock_guard lock(properties_mutex_);
    if (closed_) throw std::runtime_error("the application ends");
    const auto properties = component.properties();
    return properties ? json(*properties) : json();
}

json ApplicationControl::make_transition(ComponentHost& component, const std::string& command) {
    const bool was_in_error = component.component().getStatus() == OPROS_CS_ERROR;
    const auto transition = command == "start"  ? TRANSITION_START
                            : command == "stop" ? TRANSITION_STOP
                                                : TRANSITION_RECOVER;
    const std::string error = application_.directory().transition(component.name(), transition);
    if (!error.empty() && was_in_error && command != "recover")
        throw std::runtime_error(
            fmt::format("component {0} is in ERROR; use tandem opros recover {0} first: {1}",
                        component.name(), error_of(component)));
    if (!error.empty()) throw std::runtime_error(error);
    return {{"component", component.name()}, {"state", state_name(component.component().getStatus())}};
}

json ApplicationControl::configure(ComponentHost& component, const json& request) {
    const std::string name = text_of(request, "name");
    json properties = read_properties(component);
    if (properties.is_null())
        throw std::runtime_error(
            fmt::format("component {}: its properties cannot be read, because its cycle has not "
                        "ended: {}",
                        component.name(), running_callback(component)));
    if (!name.empty() && !properties.contains(name)) { // which the component would not read
        std::vector<std::string> known;
        for (const auto& each : properties.items()) known.push_back(each.key());
        throw std::runtime_error(
            fmt::format("component {} has no property {}{} (it has: {})", component.name(), name,
                        text::did_you_mean(name, known),
                        known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
    }
    if (request.contains("value")) {
        set_property(component, name, text_of(request, "value"));
        properties = read_properties(component);
    }
    return {{"component", component.name()}, {"properties", std::move(properties)}};
}

void ApplicationControl::set_property(ComponentHost& component, const std::string& name,
                                      const std::string& value) {
    const std::lock_guard lock(properties_mutex_);
    if (closed_) throw std::runtime_error("the application ends");
    const std::string error = component.configure(name, value);
    if (!error.empty()) throw std::runtime_error(error);
}

} // namespace tandem::control
