// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/requests/service_calls.hpp"

#include "apps/tandem/rtm/stream/untyped_ports.hpp"
#include "proxy/interceptor/corba/generic_call.hpp"
#include "proxy/wire/operation.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <span>

namespace tandem::command {
namespace {

/// Limit for open connections. When it is exceeded, all are closed and made again as needed.
constexpr std::size_t max_consumers = 64;

/// Returns the interface that the port provides, with this instance name if given. Throws std::runtime_error.
RTC::PortInterfaceProfile provided_interface(const RemotePort& port, const std::string& instance) {
    const auto& interfaces = port.profile->interfaces;
    for (CORBA::ULong i = 0; i < interfaces.length(); ++i)
        if (interfaces[i].polarity == RTC::PROVIDED &&
            (instance.empty() || instance == static_cast<const char*>(interfaces[i].instance_name)))
            return interfaces[i];
    throw std::runtime_error(fmt::format("{} provides no interface {}", port.name, instance));
}

} // namespace

/// This program's port, and the provider's object reference from the connection.
struct ServiceCalls::Consumer {
    explicit Consumer(RemotePort of, const std::string& instance) : remote(std::move(of)), port("calls") {
        const auto interface = provided_interface(remote, instance);
        port.registerConsumer(interface.instance_name, interface.type_name, provider);
        connection =
            std::make_unique<PortConnection>(remote, port, std::vector<std::string>{}, "tandem-monitor");
    }
    RemotePort remote;
    RTC::CorbaConsumerBase provider;
    RTC::CorbaPort port;
    std::unique_ptr<PortConnection> connection;
};

ServiceCalls::ServiceCalls(HostComponents& components) : components_(components) {}
ServiceCalls::~ServiceCalls() = default;

ServiceCalls::Consumer& ServiceCalls::connect(const Key& key) {
    if (const auto known = consumers_.find(key); known != consumers_.end()) return *known->second;
    if (consumers_.size() >= max_consumers) consumers_.clear();
    const auto& [pid, link, component, port, instance] = key;
    RemotePort remote = get_port(
        component.empty() ? components_.find_interceptor(pid, link) : components_.find(pid, component), port);
    return *(consumers_[key] = std::make_unique<Consumer>(std::move(remote), instance));
}

std::string ServiceCalls::call(const Frame& request) {
    const auto text = [&](const char* name) { return request.head.at(name).get<std::string>(); };
    const Key key(request.head.at("pid").get<std::uint32_t>(), text("link"), text("component"), text("port"),
                  text("instance"));
    const auto operation = wire::parse_operation(text("signature"));
    Consumer& consumer = connect(key);
    wire::MessageBuffer memory;
    std::optional<interceptor::GenericCallFailure> failure;
    const auto results = interceptor::generic_call(
        consumer.provider.getObject(), text("operation"), operation, std::as_bytes(std::span(request.bytes)),
        std::chrono::milliseconds(components_.client().timeout_ms()), memory, failure);
    if (results) return {reinterpret_cast<const char*>(results->data()), results->size()};
    if (failure->status == interceptor::GenericCallFailure::Status::unreachable)
        consumers_.erase(key); // its host is gone; the next call reconnects
    throw std::runtime_error(failure->text);
}

} // namespace tandem::command
