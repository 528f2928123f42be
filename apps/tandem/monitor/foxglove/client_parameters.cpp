// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/client_parameters.hpp"

#include "host/text/join.hpp"
#include "proxy/interceptor/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;

/// Maps `/LINK/COMPONENT` to the component and the pid of the RTM host that knows its parameters.
using Components = std::map<std::string, PlainJson>;

Components components_of(const State& state) {
    Components found;
    for (const LinkState& link : state.links) {
        const auto side = link.side_of(interceptor::model);
        if (!side || link.side(*side).state != shm::PeerState::alive) continue;
        const auto add = [&](const std::string& component) {
            if (!component.empty())
                found[fmt::format("/{}/{}", link.name, component)] = {{"pid", link.side(*side).pid},
                                                                      {"component", component}};
        };
        for (const PortState& port : link.ports) add(port.component);
        for (const SharedPort& port : link.shared_ports) add(port.component);
    }
    return found;
}

/// Splits `/LINK/COMPONENT/NAME` before NAME. The first part is empty for any other text.
std::pair<std::string, std::string> split(const std::string& name) {
    const auto link_end = name.find('/', 1);
    const auto end = link_end == std::string::npos ? link_end : name.find('/', link_end + 1);
    if (name.empty() || name[0] != '/' || end == std::string::npos) return {};
    return {name.substr(0, end), name.substr(end + 1)};
}

/// RTM values are texts. Converts a text to a number if this loses nothing.
PlainJson value_of(const std::string& text) {
    const PlainJson parsed = PlainJson::parse(text, nullptr, false);
    return parsed.is_number() ? parsed : PlainJson(text);
}

std::string text_of(const std::string& name, const PlainJson& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number() || value.is_boolean()) return value.dump();
    if (!value.is_array() || value.empty())
        throw std::runtime_error(name + ": expected a string, a number, a boolean or a list of these");
    return text::join(value, ",", [&](const PlainJson& item) { return text_of(name, item); });
}

} // namespace

void ClientParameters::read(const Names& names, const std::function<void(const Values&)>& done) {
    const Components known = components_of(state_());
    PlainJson wanted = PlainJson::array();
    std::map<std::string, std::string> paths; ///< by the request's entry
    const auto add = [&](const std::string& path, const PlainJson& component) {
        if (wanted.size() < max_components && paths.emplace(component.dump(), path).second)
            wanted.push_back(component);
    };
    for (const std::string& name : names)
        if (const auto found = known.find(split(name).first); found != known.end())
            add(found->first, found->second);
    if (names.empty())
        for (const auto& [path, component] : known) add(path, component);
    if (wanted.empty()) return done({});
    program_.ask({{{"op", "read"}, {"components", wanted}}, {}},
                 [weak = weak_from_this(), names, paths, done](const command::Frame& reply) {
                     const auto self = weak.lock();
                     if (self == nullptr) return;
                     if (!reply.head.value("ok", false)) self->line_.fail(reply.head.value("text", ""));
                     Values values;
                     for (auto entry : reply.head.value("values", PlainJson::array())) {
                         const PlainJson texts = entry["values"];
                         entry.erase("values");
                         const auto path = paths.find(entry.dump());
                         if (path == paths.end()) continue;
                         for (const auto& [name, text] : texts.items()) {
                             const std::string full = path->second + "/" + name;
                             if (names.empty() || names.count(full) != 0)
                                 values[full] = value_of(text.get<std::string>());
                         }
                     }
                     done(values);
                     for (const auto& error : reply.head.value("errors", PlainJson::array()))
                         self->line_.warn(error.get<std::string>());
                 });
}

void ClientParameters::send_values(const Values& values, const PlainJson& request) {
    PlainJson message{{"op", "parameterValues"}, {"parameters", PlainJson::array()}};
    for (const auto& [name, value] : values)
        message["parameters"].push_back({{"name", name}, {"value", value}});
    if (request.contains("id")) message["id"] = request["id"];
    line_.send(message);
}

void ClientParameters::get(const PlainJson& request) {
    read(request.at("parameterNames").get<Names>(),
         [this, request](const Values& values) { send_values(values, request); });
}

void ClientParameters::set(const PlainJson& request) {
    const Components known = components_of(state_());
    std::map<std::string, PlainJson> by_component;
    Names names;
    for (const auto& parameter : request.at("parameters")) {
        const auto name = parameter.at("name").get<std::string>();
        const auto [path, last] = split(name);
        if (known.count(path) == 0) {
            line_.fail(name + ": unknown component of a link; expected /LINK/COMPONENT/NAME");
            continue;
        }
        try {
            by_component[path][last] = text_of(name, parameter.value("value", PlainJson()));
            names.insert(name);
        } catch (const std::runtime_error& error) {
            line_.fail(error.what());
        }
    }
    for (const auto& [path, values] : by_component) {
        PlainJson one = known.at(path);
        one.update({{"op", "set"}, {"values", values}});
        program_.ask({one, {}}, [weak = weak_from_this()](const command::Frame& reply) {
            const auto self = weak.lock();
            if (self != nullptr && !reply.head.value("ok", false))
                self->line_.fail(reply.head.value("text", ""));
        });
    }
    // Requests are executed in order, so this read returns the result of the change.
    if (request.contains("id") && !names.empty())
        read(names, [this, request](const Values& values) { send_values(values, request); });
}

void ClientParameters::subscribe(const PlainJson& request) {
    for (const auto& name : request.at("parameterNames").get<Names>())
        if (subscribed_.size() < max_names) subscribed_.insert(name);
    next_poll_ = {};
}

void ClientParameters::unsubscribe(const PlainJson& request) {
    for (const auto& name : request.at("parameterNames").get<Names>()) {
        subscribed_.erase(name);
        sent_.erase(name);
    }
}

void ClientParameters::poll() {
    const auto now = std::chrono::steady_clock::now();
    if (subscribed_.empty() || reading_ || now < next_poll_) return;
    next_poll_ = now + poll_interval;
    reading_ = true;
    read(subscribed_, [this](const Values& values) {
        reading_ = false;
        Values changed;
        for (const auto& [name, value] : values) {
            const auto sent = sent_.find(name);
            if (subscribed_.count(name) == 0 || (sent != sent_.end() && sent->second == value)) continue;
            changed[name] = sent_[name] = value;
        }
        if (!changed.empty()) send_values(changed, PlainJson::object());
    });
}

} // namespace tandem::monitor
