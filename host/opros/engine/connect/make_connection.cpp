// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/make_connection.hpp"

#include "host/opros/engine/connect/data_connection.hpp"
#include "host/opros/engine/connect/event_connection.hpp"
#include "host/opros/engine/connect/service_connection.hpp"

namespace tandem::engine {
namespace {

const char* kind_name(PortType type) {
    if (type == OPROS_DATA) return "data";
    return type == OPROS_EVENT ? "event" : "service";
}

std::string type_name(const Port& port) {
    const opros_any sample = port.sample();
    return sample.empty() ? "of any type" : sample.type();
}

/// One end of a connection: its port, or an error that says what there is instead.
class End {
  public:
    End(const ConnectionProfile& connection, const PortReference& reference, ComponentHost& host)
        : connection_(connection), reference_(reference), host_(host) {}

    template <class PortClass>
    PortClass& port(const char* direction) const {
        Port* found = host_.component().getPort(reference_.port);
        if (!found) no_such_port();
        auto* port = dynamic_cast<PortClass*>(found);
        if (!port)
            throw SetupError(connection_.location, "port " + reference_.text() + " is not " + direction +
                                                       " " + kind_name(connection_.type) + " port");
        return *port;
    }

  private:
    [[noreturn]] void no_such_port() const {
        std::string known;
        for (const std::string& name : host_.component().getPortNames(connection_.type))
            known += (known.empty() ? "" : ", ") + name;
        throw SetupError(connection_.location, "component '" + reference_.component + "' has no port '" +
                                                   reference_.port + "', its " + kind_name(connection_.type) +
                                                   " ports are: " + (known.empty() ? "none" : known));
    }

    const ConnectionProfile& connection_;
    const PortReference& reference_;
    ComponentHost& host_;
};

template <class Source, class Target>
void check_types(const ConnectionProfile& connection, Source& source, Target& target) {
    if (source.checkType(&target)) return;
    std::string text = "type mismatch: output " + connection.source.text() + " is " + type_name(source) +
                       ", input " + connection.target.text() + " is " + type_name(target);
    for (const std::string& more : {source.typeError(), target.typeError()})
        if (!more.empty()) text += "; " + more;
    throw SetupError(connection.location, text);
}

} // namespace

std::unique_ptr<Connection> make_connection(const ConnectionProfile& connection, ComponentHost& source,
                                            ComponentHost& target, WorkerPool& workers) {
    const End from(connection, connection.source, source), to(connection, connection.target, target);
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
        return std::make_unique<EventConnection>(out, in, target, workers.of(&target));
    }
    auto& required = from.port<RequiredServicePort>("a required");
    auto& provided = to.port<ProvidedServicePort>("a provided");
    try {
        return std::make_unique<ServiceConnection>(required, provided, target, workers);
    } catch (const SetupError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw SetupError(connection.location, "service " + connection.source.text() + " -> " +
                                                  connection.target.text() + ": " + error.what());
    }
}

} // namespace tandem::engine
