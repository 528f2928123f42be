// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/make_connection.hpp"

#include "host/log/log.hpp"
#include "host/opros/engine/connect/data_connection.hpp"
#include "host/opros/engine/connect/event_connection.hpp"
#include "host/opros/engine/connect/service_connection.hpp"
#include "host/opros/engine/profile/port_type.hpp"

namespace tandem::engine {
namespace {

/// A port that learns its type only when it is connected returns an empty name.
std::string type_name(const Port& port) {
    const opros_any sample = port.sample();
    return sample.empty() ? "of any type" : sample.type();
}

std::string with_article(const std::string& port_type) {
    return (port_type == "event" ? "an " : "a ") + port_type;
}

/// Looks up the port at one side of a connection.
class PortLookup {
  public:
    PortLookup(const ConnectionProfile& connection, const PortReference& reference, ComponentHost& host)
        : connection_(connection), reference_(reference), host_(host) {}

    /// `direction` includes the article ("an output"), for the message. Throws SetupError.
    template <class PortClass>
    PortClass& port(const char* direction) const {
        Port* found = host_.component().getPort(reference_.port);
        if (!found) throw_no_such_port();
        if (auto* port = dynamic_cast<PortClass*>(found)) return *port;
        const std::string expected = port_type_name(connection_.type);
        const std::string actual = port_type_name(found->getType());
        const std::string port = "port " + reference_.text() + " is ";
        throw SetupError(connection_.location, expected == actual
                                                   ? port + "not " + direction + " " + expected + " port"
                                                   : port + with_article(actual) + " port, not " +
                                                         with_article(expected) + " port");
    }

  private:
    [[noreturn]] void throw_no_such_port() const {
        std::string known;
        for (const std::string& name : host_.component().getPortNames(connection_.type))
            known += (known.empty() ? "" : ", ") + name;
        throw NoSuchPort(connection_.location, "component '" + reference_.component + "' has no port '" +
                                                   reference_.port + "', its " +
                                                   port_type_name(connection_.type) +
                                                   " ports are: " + (known.empty() ? "none" : known));
    }

    const ConnectionProfile& connection_;
    const PortReference& reference_;
    ComponentHost& host_;
};

/// The source decides whether the types match. A bridge's port may give a better reason than the two type names.
template <class Source, class Target>
void check_types(const ConnectionProfile& connection, Source& source, Target& target) {
    if (source.checkType(&target)) return;
    std::string text = "type mismatch: output " + connection.source.text() + " is " + type_name(source) +
                       ", input " + connection.target.text() + " is " + type_name(target);
    for (const std::string& reason : {source.typeError(), target.typeError()})
        if (!reason.empty()) text += "; " + reason;
    throw SetupError(connection.location, text);
}

/// Asks the target, too, because the port of a bridge learns the other port's type only this way. For all other ports
/// the source has already decided.
void check_event_target(const ConnectionProfile& connection, EventPort& source, EventPort& target) {
    if (!target.checkType(&source) && !target.typeError().empty())
        throw SetupError(connection.location, "type mismatch: output " + connection.source.text() + " is " +
                                                  type_name(source) + "; " + target.typeError());
}

std::unique_ptr<Connection> connect_services(const ConnectionProfile& connection,
                                             RequiredServicePort& required, ProvidedServicePort& provided,
                                             ComponentHost& provider) {
    try {
        auto made = std::make_unique<ServiceConnection>(required, provided, provider);
        for (const auto& refusal : made->refusals())
            log::warn("{}: {}; the other methods of the port are connected", connection.location.text(),
                      refusal);
        return made;
    } catch (const SetupError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw SetupError(connection.location, "service " + connection.source.text() + " -> " +
                                                  connection.target.text() + ": " + error.what());
    }
}

} // namespace

std::unique_ptr<Connection> make_connection(const ConnectionProfile& connection, ComponentHost& source,
                                            ComponentHost& target) {
    const PortLookup from(connection, connection.source, source), to(connection, connection.target, target);
    if (connection.type == OPROS_DATA) {
        auto& out = from.port<OutputDataPortInterface>("an output");
        auto& in = to.port<InputDataPortInterface>("an input");
        check_types(connection, out, static_cast<DataPort&>(in));
        return std::make_unique<DataConnection>(out, in);
    }
    if (connection.type == OPROS_EVENT) {
        auto& out = from.port<OutputEventPortInterface>("an output");
        auto& in = to.port<InputEventPortInterface>("an input");
        check_types(connection, out, static_cast<EventPort&>(in));
        check_event_target(connection, out, in);
        return std::make_unique<EventConnection>(out, in, connection.target.port, target);
    }
    auto& required = from.port<RequiredServicePort>("a required");
    auto& provided = to.port<ProvidedServicePort>("a provided");
    return connect_services(connection, required, provided, target);
}

std::unique_ptr<Connection> make_connection(Port& source, Port& destination, ComponentHost& target) {
    auto* out = dynamic_cast<OutputEventPortInterface*>(&source);
    auto* in = dynamic_cast<InputEventPortInterface*>(&destination);
    if (out && in) {
        // The second check shows the bridge's port an event of the other port's type.
        if (!out->checkType(static_cast<EventPort*>(in)) || !in->checkType(static_cast<EventPort*>(out)))
            throw std::runtime_error(out->typeError());
        return std::make_unique<EventConnection>(*out, *in, destination.getName(), target);
    }
    auto* required = dynamic_cast<RequiredServicePort*>(&source);
    auto* provided = dynamic_cast<ProvidedServicePort*>(&destination);
    if (!required || !provided) throw std::runtime_error("ports of these kinds cannot be connected");
    return std::make_unique<ServiceConnection>(*required, *provided, target);
}

} // namespace tandem::engine
