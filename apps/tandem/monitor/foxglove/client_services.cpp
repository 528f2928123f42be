// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/foxglove/client_services.hpp"

#include "apps/tandem/observe/json_message.hpp"
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/interceptor/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <set>
#include <span>
#include <utility>

namespace tandem::monitor {
namespace {

using PlainJson = nlohmann::json;
constexpr char response_op = 0x03;

/// Returns the target for `tandem rtm requests` to call the port's operations; null if CORBA cannot reach it.
PlainJson target_of(const SharedPort& port, const LinkState& link) {
    const auto rtm = link.side_of(interceptor::model);
    if (!rtm || link.side(*rtm).state != shm::PeerState::alive) return nullptr;
    const bool rtc = port.owner == *rtm, provided = port.kind == "provided";
    if (!provided && !(rtc && port.kind == "required")) return nullptr;
    // With several interfaces in a port, names end with the interface; with several ports, they begin with the RTC.
    std::string name = port.name;
    const std::string prefix = port.component + ".", suffix = "." + port.instance;
    if (provided && name.compare(0, prefix.size(), prefix) == 0) name = name.substr(prefix.size());
    if (rtc && name.size() > suffix.size() && name.ends_with(suffix))
        name.resize(name.size() - suffix.size());
    // An OPRoS component provides the services that an RTC requires. They are at the host's end of the link.
    return {{"op", "call"},      {"pid", link.side(*rtm).pid},
            {"link", link.name}, {"component", provided ? port.component : std::string()},
            {"port", name},      {"instance", rtc ? port.instance : std::string()}};
}

void for_each_operation(
    const State& state,
    const std::function<void(const LinkState&, const SharedPort&, const link::ServiceOperation&)>& look) {
    for (const LinkState& link : state.links)
        for (const SharedPort& port : link.shared_ports)
            for (const auto& operation : port.operations) look(link, port, operation);
}

PlainJson schema_of(const std::string& name, const wire::Type& message, bool has_result) {
    const auto idl =
        command::message_idl("IDL:" + name + ":1.0", command::with_member_names(message, has_result));
    return {
        {"encoding", "cdr"}, {"schemaName", idl.name}, {"schemaEncoding", "omgidl"}, {"schema", idl.text}};
}

bool can_be_sent(const wire::Operation& operation) {
    for (const auto* message : {&operation.request, &operation.reply})
        for (const wire::Type& member : message->children)
            if (!command::takes_bytes(member)) return false;
    return wire::first_unsupported(operation).empty();
}

} // namespace

void ClientServices::update(const State& state) {
    PlainJson added = PlainJson::array(), removed = PlainJson::array();
    std::set<std::string> present;
    for_each_operation(state, [&](const LinkState& link, const SharedPort& port,
                                  const link::ServiceOperation& operation) {
        PlainJson target = target_of(port, link);
        if (target.is_null()) return;
        target["operation"] = operation.name;
        target["signature"] = operation.signature;
        const std::string name = fmt::format("/{}/{}/{}", link.name, port.name, operation.name);
        const std::string key = fmt::format("{} {} {}", name, shm::name_of(port.owner), operation.signature);
        if (!present.insert(key).second) return;
        if (const auto known = services_.find(key); known != services_.end()) {
            known->second.target = target; // the host may have restarted
            if (std::exchange(known->second.present, true)) return;
        } else if (services_.size() >= max_services) {
            return;
        }
        try {
            auto types = wire::parse_operation(operation.signature);
            if (!can_be_sent(types)) return;
            Service& service = services_[key];
            if (service.id == 0)
                service = {static_cast<std::uint32_t>(services_.size()), target, std::move(types)};
            const std::string path = port.name + "/" + operation.name;
            added.push_back({{"id", service.id},
                             {"name", name},
                             {"type", port.type + " " + operation.name},
                             {"request", schema_of(path + "_request", service.operation.request, false)},
                             {"response", schema_of(path + "_reply", service.operation.reply,
                                                    service.operation.result.has_value())}});
        } catch (const wire::SignatureError&) { // untrusted data of another process
        }
    });
    for (auto& [key, service] : services_)
        if (present.count(key) == 0 && std::exchange(service.present, false)) removed.push_back(service.id);
    if (!removed.empty()) line_.send({{"op", "unadvertiseServices"}, {"serviceIds", removed}});
    if (!added.empty()) line_.send({{"op", "advertiseServices"}, {"services", added}});
}

void ClientServices::refuse(std::uint32_t service, std::uint32_t call, const std::string& text) {
    line_.send({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", text}});
}

void ClientServices::call(std::string_view request) {
    std::uint32_t head[3]; // service, call, length of the encoding's name; little-endian like this machine
    if (request.size() < sizeof head) return line_.warn("expected a service call request");
    std::memcpy(head, request.data(), sizeof head);
    request.remove_prefix(sizeof head);
    const auto [id, number, length] = head;
    if (length > request.size()) return line_.warn("expected a service call request");
    const std::string encoding(request.substr(0, length));
    request.remove_prefix(length);
    const auto found = std::find_if(services_.begin(), services_.end(), [id = id](const auto& service) {
        return service.second.id == id && service.second.present;
    });
    if (found == services_.end()) return refuse(id, number, "unknown service");
    if (encoding != "cdr" && encoding != "json") return refuse(id, number, "expected encoding cdr or json");
    if (open_calls_ >= max_calls) return refuse(id, number, "16 calls are pending; try again");
    const Service& service = found->second;
    std::string bytes;
    try {
        const auto json = [&] {
            const auto message = command::json_to_message(
                command::with_member_names(service.operation.request, false), command::parse_json(request));
            return std::string(reinterpret_cast<const char*>(message.data()), message.size());
        };
        bytes = encoding == "json" ? json() : command::behind_encapsulation(request);
    } catch (const std::exception& error) { // from JSON or from the message
        return refuse(id, number, error.what());
    }
    ++open_calls_;
    program_.ask({service.target, std::move(bytes)},
                 [weak = weak_from_this(), id = id, number = number, encoding,
                  operation = service.operation](const command::Frame& reply) {
                     const auto self = weak.lock();
                     if (self == nullptr) return;
                     --self->open_calls_;
                     self->answer(id, number, encoding, operation, reply);
                 });
}

void ClientServices::answer(std::uint32_t service, std::uint32_t call, const std::string& encoding,
                            const wire::Operation& operation, const command::Frame& reply) {
    if (!reply.head.value("ok", false)) return refuse(service, call, reply.head.value("text", ""));
    std::string payload(reinterpret_cast<const char*>(command::encapsulation), sizeof command::encapsulation);
    payload += reply.bytes;
    if (encoding == "json") {
        try {
            const auto type = command::with_member_names(operation.reply, operation.result.has_value());
            payload = command::message_to_json(type, std::as_bytes(std::span(reply.bytes)))
                          .dump(-1, ' ', false, PlainJson::error_handler_t::replace);
        } catch (const std::runtime_error& error) {
            return refuse(service, call, error.what());
        }
    }
    const std::uint32_t head[] = {service, call, static_cast<std::uint32_t>(encoding.size())};
    std::string message(1 + sizeof head, response_op);
    std::memcpy(message.data() + 1, head, sizeof head);
    line_.send_binary(message + encoding + payload);
}

} // namespace tandem::monitor
