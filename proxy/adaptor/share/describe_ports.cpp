// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/describe_ports.hpp"

#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/adaptor/service/method_types.hpp"

#include <EventPort.h>
#include <InputDataPortInterface.h>
#include <InputEventPortInterface.h>
#include <ProvidedServicePort.h>
#include <RequiredServicePort.h>

#include <fmt/format.h>

namespace tandem::adaptor {
namespace {

using link::PortKind;

/// Describes the ports of one component.
class PortDescriber {
  public:
    PortDescriber(const std::string& component_name, ComponentDirectory& directory,
                  const std::map<std::string, std::string>& interfaces, link::PortTable& table)
        : component_name_(component_name), directory_(directory), component_(*directory.find(component_name)),
          interfaces_(interfaces), table_(table) {}

    std::vector<std::string> describe() {
        for (const auto& name : component_.getPortNames(OPROS_DATA))
            if (auto* port = dynamic_cast<DataPort*>(component_.getPort(name)))
                add_data_port(name, *port, dynamic_cast<InputDataPortInterface*>(port) != nullptr);
        for (const auto& name : component_.getPortNames(OPROS_EVENT))
            if (auto* port = dynamic_cast<EventPort*>(component_.getPort(name)))
                add_event_port(name, *port, dynamic_cast<InputEventPortInterface*>(port) != nullptr);
        for (const auto& name : component_.getPortNames(OPROS_SERVICE))
            if (auto* port = dynamic_cast<ServicePortInterface*>(component_.getPort(name)))
                add_service_port(name, *port);
        return std::move(refused_);
    }

  private:
    link::Port make_port(const std::string& name, PortKind kind) const {
        link::Port port;
        port.kind = kind;
        port.name = component_name_ + "." + name;
        port.component = component_name_;
        return port;
    }

    /// The IDL name that the user has given; otherwise `default_name`.
    std::string interface_of(const link::Port& port, const std::string& default_name) const {
        const auto found = interfaces_.find(port.name);
        return found == interfaces_.end() ? default_name : found->second;
    }

    static PortKind data_kind(bool is_input) { return is_input ? PortKind::data_in : PortKind::data_out; }

    void add_data_port(const std::string& name, const DataPort& port, bool is_input) {
        const opros_any sample = port.sample();
        link::Port shared = make_port(name, data_kind(is_input));
        shared.type = interface_of(shared, sample.type());
        add_message(std::move(shared), sample, "");
    }

    void add_event_port(const std::string& name, const EventPort& port, bool is_input) {
        const opros_any sample = port.sample();
        link::Port shared = make_port(name, data_kind(is_input));
        shared.type = interface_of(shared, "event with content " + sample.type());
        add_message(std::move(shared), sample, "{id}s");
    }

    void add_message(link::Port port, const opros_any& sample, const std::string& head) {
        try {
            if (!sample.serializable()) throw opros::archive::archive_type_exception();
            port.signature = head + wire::to_named_signature(type_of(sample, {}));
            table_.ports.push_back(std::move(port));
        } catch (const std::exception& error) { // thrown by the archive, or by the type's own load()
            refused_.push_back(
                fmt::format("port '{}' is not shared: OPRoS type {} cannot be serialized ({}); give "
                            "it save() and load()",
                            port.name, sample.type(), error.what()));
        }
    }

    void add_service_port(const std::string& name, ServicePortInterface& port) {
        const bool is_required = dynamic_cast<RequiredServicePort*>(&port) != nullptr;
        link::Port shared =
            make_port(name, is_required ? PortKind::service_required : PortKind::service_provided);
        const std::string interface = interface_of(shared, name);
        const auto dot = interface.find('.');
        shared.type = interface.substr(0, dot);
        shared.instance = dot == std::string::npos ? name : interface.substr(dot + 1);
        if (port.isDynamic()) {
            refused_.push_back(fmt::format(
                "port '{}' is not shared: it learns its methods only when it is connected", shared.name));
            return;
        }
        if (is_required && directory_.isConnected(component_name_, name)) {
            refused_.push_back(
                fmt::format("port '{}' is not shared: the application connects it", shared.name));
            return;
        }
        for (auto method = port.getFirst(); method != port.getEnd(); ++method) try {
                shared.operations.push_back(
                    {method->first, describe_method(*method->second).operation_signature()});
            } catch (const wire::SignatureError&) {
                refused_.push_back(
                    fmt::format("method '{}' of port '{}' is not shared: one of its types cannot be "
                                "serialized",
                                method->first, shared.name));
            }
        table_.ports.push_back(std::move(shared));
    }

    const std::string& component_name_;
    ComponentDirectory& directory_;
    Component& component_;
    const std::map<std::string, std::string>& interfaces_;
    link::PortTable& table_;
    std::vector<std::string> refused_;
};

} // namespace

std::vector<std::string> describe_ports(const std::string& component_name, ComponentDirectory& directory,
                                        const std::map<std::string, std::string>& interfaces,
                                        link::PortTable& table) {
    return PortDescriber(component_name, directory, interfaces, table).describe();
}

} // namespace tandem::adaptor
