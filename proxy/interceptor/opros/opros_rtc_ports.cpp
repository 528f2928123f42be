// SPDX-License-Identifier: Apache-2.0
// OprosRtc: its ports and its configuration parameters.
#include "proxy/interceptor/opros/opros_rtc.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/engine/capabilities.hpp"
#include "proxy/interceptor/opros/shown_type.hpp"
#include "proxy/interceptor/service/interface_operations.hpp"
#include "proxy/wire/type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tandem::interceptor {
namespace control = link::control;
using link::CallStatus;

namespace {

/// A listener that reports new and ended connections.
class ChangeListener final : public RTC::ConnectorListener {
  public:
    explicit ChangeListener(std::function<void()> changed) : changed_(std::move(changed)) {}
    ReturnCode operator()(RTC::ConnectorInfo&) override {
        changed_();
        return NO_CHANGE;
    }

  private:
    std::function<void()> changed_;
};

class SetListener final : public RTC::ConfigurationSetListener {
  public:
    explicit SetListener(std::function<void()> changed) : changed_(std::move(changed)) {}
    void operator()(const coil::Properties&) override { changed_(); }

  private:
    std::function<void()> changed_;
};

class SetNameListener final : public RTC::ConfigurationSetNameListener {
  public:
    explicit SetNameListener(std::function<void()> changed) : changed_(std::move(changed)) {}
    void operator()(const char*) override { changed_(); }

  private:
    std::function<void()> changed_;
};

} // namespace

std::string OprosRtc::channel_key(const link::Port& port) {
    return fmt::format("{}/{}#{}", source_.link_name, port.name, types_.number(port));
}

void OprosRtc::show(const link::Port& port, RTC::PortBase& shown, std::function<void()> add) {
    add();
    shown_ports_.push_back({port, &shown, std::move(add)});
}

void OprosRtc::hide_ports_but(const std::vector<link::Port>& ports) {
    for (auto& each : shown_ports_) {
        const auto is_it = [&](const auto& port) { return port.is_same(each.source); };
        if (!each.shown || std::any_of(ports.begin(), ports.end(), is_it)) continue;
        removePort(*each.port); // ends its connections
        each.shown = false;
        log::warn("{}: port '{}' of the OPRoS component, {} '{}', was removed and is no longer shown",
                  getInstanceName(), each.source.name, each.source.type, each.source.signature);
    }
}

/// Returns false, after a line in the log, if the port cannot be shown.
bool OprosRtc::add_port(const link::Port& port) {
    const auto is_it = [&](const auto& each) { return each.source.is_same(port); };
    const auto known = std::find_if(shown_ports_.begin(), shown_ports_.end(), is_it);
    if (known != shown_ports_.end()) {
        known->add();
        return known->shown = true;
    }
    const std::string name = port.name.substr(source_.component.name.size() + 1);
    if (link::is_data_port(port.kind)) return add_data_port(port, name);
    if (port.kind == link::PortKind::service_provided) return add_provided_port(port, name);
    add_required_port(port, name);
    return true;
}

// The operations are those of the IDL, where it is known: the component's methods say nothing about out arguments and
// exceptions.
void OprosRtc::add_required_port(const link::Port& port, const std::string& name) {
    link::Port required = port;
    required.operations = operations_of(port.type);
    Consumer consumer{std::make_unique<MirrorProvidedPort>(std::move(required), source_.call_timeout),
                      std::make_unique<RTC::CorbaPort>(name.c_str())};
    consumer.port->registerConsumer(port.instance.c_str(), port.type.c_str(), consumer.source->consumer());
    show(port, *consumer.port, [this, shown = consumer.port.get()] { addPort(*shown); });
    required_by_channel_.add(port.name, *consumer.source, link::port_id(port.name));
    consumers_.push_back(std::move(consumer));
}

void OprosRtc::send_interfaces() {
    for (const auto& consumer : consumers_) {
        const auto& port = consumer.source->port();
        const auto binding = control::encode(control::ServiceBinding{port.name, port.operations});
        const auto reply = source_.link->call({"", control::bind, "", binding},
                                              control::command_timeout(source_.call_timeout));
        if (reply.status != CallStatus::ok && source_.link->is_up())
            log::error("{}: required service port '{}' is not ready: {}", getInstanceName(), port.name,
                       reply.text());
    }
}

/// nullptr after the last one.
OprosRtc::Output* OprosRtc::output_at(std::size_t index) {
    const std::lock_guard lock(outputs_mutex_);
    return index < outputs_.size() ? &outputs_[index] : nullptr;
}

void OprosRtc::set_ports(const std::vector<link::Port>& ports) {
    bool added = false;
    std::unique_lock following(follow_mutex_);
    if (finalized_) return;
    hide_ports_but(ports);
    const auto before = std::exchange(source_.ports, ports);
    for (const auto& port : ports) {
        const auto is_it = [&](const auto& known) { return known.is_same(port); };
        if (std::any_of(before.begin(), before.end(), is_it)) continue;
        if (!add_port(port)) continue;
        added = true;
        log::info("{}: port '{}' was added to the OPRoS component and is shown", getInstanceName(),
                  port.name);
    }
    // An activation makes service ports callable. It may be over already.
    if (added && state() == RTC::ACTIVE_STATE) m_portAdmin.activatePorts();
    following.unlock(); // the end of this RTC does not wait for the peer
    if (added) send_interfaces();
}

bool OprosRtc::add_provided_port(const link::Port& port, const std::string& name) {
    Service service;
    try {
        service.target = std::make_unique<MirrorRequiredPort>(port, *source_.link, source_.call_timeout);
        service.target->bind({port.name, port.operations}); // the component that provides it exists
    } catch (const wire::SignatureError& error) {           // the signature came from another process
        log::warn("{}: port '{}' is not shown: {}", getInstanceName(), name, error.what());
        return false;
    }
    service.port = std::make_unique<RTC::CorbaPort>(name.c_str());
    service.port->registerProvider(port.instance.c_str(), port.type.c_str(), service.target->servant());
    show(port, *service.port, [this, shown = service.port.get()] { addPort(*shown); });
    services_.push_back(std::move(service));
    return true;
}

bool OprosRtc::add_data_port(const link::Port& port, const std::string& name) {
    ShownType type;
    try {
        type = shown_type(port);
    } catch (const std::runtime_error& error) { // no type fits, or a signature of another process is damaged
        log::warn("{}: port '{}' is not shown: {}", getInstanceName(), name, error.what());
        return false;
    }
    LinkChannel channel = make_link_channel(wire::parse_signature(type.signature));
    const std::string key = channel_key(port);
    const bool is_input = port.kind == link::PortKind::data_in;
    if (is_input)
        channel.writer = &source_.link->writer(port);
    else
        channel.reader = &source_.link->reader(port);
    LinkBuffer::register_channel(key, channel);
    channel_keys_.push_back(key);
    if (is_input) {
        inputs_.push_back(std::make_unique<OprosInPort>(name.c_str(), type.repository_id.c_str(), key));
        auto& in = *inputs_.back();
        show(port, in, [this, name, &in] { addInPort(name.c_str(), in); });
        return true;
    }
    auto out = std::make_unique<ForwardingOutPort>(name.c_str(), type.repository_id.c_str(), key);
    for (const auto event :
         {RTC::ConnectorListenerType::ON_CONNECT, RTC::ConnectorListenerType::ON_DISCONNECT})
        out->addConnectorListener(event, new ChangeListener(source_.connections_changed));
    show(port, *out, [this, name, shown = out.get()] { addOutPort(name.c_str(), *shown); });
    const std::lock_guard lock(outputs_mutex_);
    outputs_.push_back({std::move(out), port});
    return true;
}

void OprosRtc::add_configuration() {
    for (const auto& [name, value] : source_.component.properties) {
        sent_[name] = value;
        if constexpr (!engine::shows_parameter_defaults)
            if (auto& configured = m_properties["conf.default." + name]; configured.empty()) // by rtc.conf
                configured = value;
        bindParameter(name.c_str(), values_[name], value.c_str());
    }
    addConfigurationSetListener(RTC::ConfigurationSetListenerType::ON_SET_CONFIG_SET,
                                new SetListener(source_.configuration_changed));
    addConfigurationSetNameListener(RTC::ConfigurationSetNameListenerType::ON_ACTIVATE_CONFIG_SET,
                                    new SetNameListener(source_.configuration_changed));
}

void OprosRtc::send_configuration(const std::vector<link::Property>* known) {
    if (known)
        for (const auto& [name, value] : *known) sent_[name] = value;
    const coil::Properties set = m_configsets.getActiveConfigurationSet();
    for (auto& [name, sent] : sent_) {
        const std::string value = set.findNode(name) ? set.getProperty(name) : sent;
        if (value == sent) continue;
        const auto setting = control::encode(control::Setting{source_.component.name, name, value});
        const auto reply = source_.link->call({"", control::configure, "", setting},
                                              control::command_timeout(source_.call_timeout));
        if (reply.status == CallStatus::ok)
            sent = value;
        else if (source_.link->is_up())
            log::error("{}: the OPRoS component was not given {} = '{}': {}", getInstanceName(), name, value,
                       reply.text());
    }
}

std::vector<std::string> OprosRtc::listen() {
    std::vector<std::string> channels;
    for (std::size_t i = 0; auto* output = output_at(i); ++i) {
        const bool listens = output->port->is_connected();
        if (listens != output->listens) {
            if (listens) output->port->discard(); // the first receiver gets no earlier messages
            source_.link->set_arrival_listener(source_.link->reader(output->source),
                                               listens ? std::function<void()>([this] { wake(); }) : nullptr);
            output->listens = listens;
        }
        if (listens) channels.push_back(output->source.name);
    }
    return channels;
}

} // namespace tandem::interceptor
