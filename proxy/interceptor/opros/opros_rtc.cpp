// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/opros_rtc.hpp"

#include "proxy/interceptor/opros/shown_type.hpp"
#include "proxy/interceptor/service/interface_operations.hpp"
#include "proxy/wire/type.hpp"

#include <rtm/Manager.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace tandem::interceptor {
namespace control = link::control;
using control::ComponentState;
using link::CallStatus;

namespace {

// The manager's factory makes components without arguments; the source of the one that this thread creates.
thread_local OprosRtc::Source* source_of_creation = nullptr;

class SourceScope {
  public:
    explicit SourceScope(OprosRtc::Source& source) { source_of_creation = &source; }
    ~SourceScope() { source_of_creation = nullptr; }
    SourceScope(const SourceScope&) = delete;
    SourceScope& operator=(const SourceScope&) = delete;
};

/// In an argument of a component these separate it from others; no name of a component needs them.
bool is_plain(const std::string& name) {
    return !name.empty() && name.find_first_of("?&=,:/ \t\n") == std::string::npos;
}

/// A listener to connections that says that there was a change.
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

// ---- creation and end

OprosRtc& OprosRtc::create(RTC::Manager& manager, Source source) {
    const std::string& name = source.component.name;
    if (!is_plain(name)) throw RTC::ManagerError(fmt::format("'{}' is no name that an RTC can have", name));
    const std::string type = is_plain(source.component.type) ? source.component.type : implementation_id;
    // A context whose thread sleeps until it is told, and which makes transitions in the thread that asks for them.
    const std::string arguments =
        fmt::format("{}?instance_name={}&type_name={}&execution_contexts=ExtTrigExecutionContext(opros)",
                    implementation_id, name, type);
    const SourceScope scope(source);
    return dynamic_cast<OprosRtc&>(manager.createOrThrow(arguments));
}

OprosRtc::OprosRtc(RTC::Manager* manager) : RTC::DataFlowComponentBase(manager) {
    if (source_of_creation) source_ = *source_of_creation;
}

OprosRtc::~OprosRtc() {
    if (!finalized_) // it could not be created
        for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
}

RTC::ReturnCode_t OprosRtc::onInitialize() {
    if (!source_.link) {
        spdlog::error(
            "{}: an RTC of type {} is created for each OPRoS component that an AdaptorComp shares, and not "
            "by name",
            getInstanceName(), implementation_id);
        return RTC::RTC_ERROR;
    }
    context_ = dynamic_cast<RTC::ExtTrigExecutionContext*>(m_eclist.empty() ? nullptr : m_eclist.front());
    if (!context_) return RTC::RTC_ERROR;
    for (const auto& port : source_.ports) add_port(port);
    add_configuration();
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onFinalize() {
    if (!source_.link) return RTC::RTC_OK;
    if (must_tell_component()) command(control::exit, control::deactivation_timeout);
    for (const auto& output : outputs_) source_.link->set_arrival_listener(output.channel, {});
    for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
    {
        // The task thread may be in the execution context, which is taken from this RTC after this callback.
        const std::unique_lock following(follow_mutex_, control::deactivation_timeout);
        finalized_ = true;
    }
    source_.finalized();
    return RTC::RTC_OK;
}

void OprosRtc::leave(RTC::Manager& manager) {
    leaving_ = true;
    if (!finalized_) manager.deleteComponent(this);
}

/// What is to be told the component: not when this RTC only follows it, ends with its own host, or nobody is there.
bool OprosRtc::must_tell_component() const {
    return !leaving_ && !is_following() && !RTC::Manager::terminationRequested() && source_.link->is_up();
}

// ---- ports and configuration

std::string OprosRtc::channel_key(const link::Port& port) const {
    return source_.link_name + "/" + port.name;
}

void OprosRtc::add_port(const link::Port& port) {
    const std::string name = port.name.substr(source_.component.name.size() + 1);
    if (link::is_data_port(port.kind))
        add_data_port(port, name);
    else if (port.kind == link::PortKind::service_provided)
        add_provided_port(port, name);
    else
        add_required_port(port, name);
}

// The operations are those of the IDL, where it is known: the component's methods say nothing of out arguments and
// exceptions.
void OprosRtc::add_required_port(const link::Port& port, const std::string& name) {
    link::Port required = port;
    required.operations = operations_of(port.type);
    Consumer consumer{std::make_unique<MirrorProvidedPort>(std::move(required), source_.call_timeout),
                      std::make_unique<RTC::CorbaPort>(name.c_str())};
    consumer.port->registerConsumer(port.instance.c_str(), port.type.c_str(), consumer.source->consumer());
    addPort(*consumer.port);
    consumers_.push_back(std::move(consumer));
}

void OprosRtc::send_interfaces() {
    for (const auto& consumer : consumers_) {
        const auto& port = consumer.source->port();
        const auto binding = control::encode(control::ServiceBinding{port.name, port.operations});
        const auto reply = source_.link->call({"", control::bind, "", binding}, source_.call_timeout);
        if (reply.status != CallStatus::ok && source_.link->is_up())
            spdlog::error("{}: required service port '{}' is not ready: {}", getInstanceName(), port.name,
                          reply.text());
    }
}

MirrorProvidedPort* OprosRtc::find_required(std::string_view channel) const {
    for (const auto& consumer : consumers_)
        if (consumer.source->port().name == channel) return consumer.source.get();
    return nullptr;
}

void OprosRtc::add_provided_port(const link::Port& port, const std::string& name) {
    Service service;
    try {
        service.target = std::make_unique<MirrorRequiredPort>(port, *source_.link, source_.call_timeout);
        service.target->bind({port.name, port.operations}); // the component that provides it is there
    } catch (const wire::SignatureError& error) {           // it came from another process
        spdlog::warn("{}: port '{}' is not shown: {}", getInstanceName(), name, error.what());
        return;
    }
    service.port = std::make_unique<RTC::CorbaPort>(name.c_str());
    service.port->registerProvider(port.instance.c_str(), port.type.c_str(), service.target->servant());
    addPort(*service.port);
    services_.push_back(std::move(service));
}

void OprosRtc::add_data_port(const link::Port& port, const std::string& name) {
    std::string type;
    try {
        type = shown_type(port);
    } catch (const std::runtime_error& error) { // no type fits, or a signature of another process is damaged
        spdlog::warn("{}: port '{}' is not shown: {}", getInstanceName(), name, error.what());
        return;
    }
    LinkChannel channel = make_link_channel(wire::parse_signature(RTC::InterfaceSignatures::type(type)));
    const std::string key = channel_key(port);
    const bool is_input = port.kind == link::PortKind::data_in;
    if (is_input)
        channel.writer = &source_.link->writer(port.name);
    else
        channel.reader = &source_.link->reader(port.name);
    LinkBuffer::register_channel(key, channel);
    channel_keys_.push_back(key);
    if (is_input) {
        inputs_.push_back(std::make_unique<OprosInPort>(name.c_str(), type.c_str(), key));
        addInPort(name.c_str(), *inputs_.back());
        return;
    }
    auto out = std::make_unique<ForwardingOutPort>(name.c_str(), type.c_str(), key);
    for (const auto event :
         {RTC::ConnectorListenerType::ON_CONNECT, RTC::ConnectorListenerType::ON_DISCONNECT})
        out->addConnectorListener(event, new ChangeListener(source_.connections_changed));
    addOutPort(name.c_str(), *out);
    outputs_.push_back({std::move(out), port.name});
}

void OprosRtc::add_configuration() {
    for (const auto& [name, value] : source_.component.properties) {
        sent_[name] = value;
        bindParameter(name.c_str(), values_[name], value.c_str());
    }
    addConfigurationSetListener(RTC::ON_SET_CONFIG_SET, new SetListener(source_.configuration_changed));
    addConfigurationSetNameListener(RTC::ON_ACTIVATE_CONFIG_SET,
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
        const auto reply = source_.link->call({"", control::configure, "", setting}, source_.call_timeout);
        if (reply.status == CallStatus::ok)
            sent = value;
        else if (source_.link->is_up())
            spdlog::error("{}: the OPRoS component was not given {} = '{}': {}", getInstanceName(), name,
                          value, reply.text());
    }
}

std::vector<std::string> OprosRtc::listen() {
    std::vector<std::string> channels;
    for (auto& output : outputs_) {
        const bool listens = output.port->is_connected();
        if (listens != output.listens) {
            if (listens) output.port->discard(); // what came before is of no interest to the first receiver
            source_.link->set_arrival_listener(output.channel,
                                               listens ? std::function<void()>([this] { wake(); }) : nullptr);
            output.listens = listens;
        }
        if (listens) channels.push_back(output.channel);
    }
    return channels;
}

/// One cycle is enough for all messages that come before it. [notifier-thread]
void OprosRtc::wake() {
    if (!wake_pending_.exchange(true)) context_->tick();
}

// ---- state

bool OprosRtc::remember(const control::StateReport& report) {
    const std::lock_guard lock(state_mutex_);
    if (peer_is_there_ && report.sequence <= sequence_) return false;
    peer_is_there_ = true;
    sequence_ = report.sequence;
    component_state_ = report.state;
    fault_ = report.state == ComponentState::error;
    return true;
}

void OprosRtc::peer_lost() {
    const std::lock_guard lock(state_mutex_);
    peer_is_there_ = false;
    sequence_ = 0;
    component_state_ = ComponentState::error;
    fault_ = true;
}

RTC::LifeCycleState OprosRtc::state() const { return context_->getComponentState(m_objref.in()); }

// The context carries out each transition in this thread, whose callbacks then tell the component nothing. One that
// it refuses because another is under way, whoever asks for that one is told by the component's next report.
bool OprosRtc::follow() {
    const std::lock_guard following(follow_mutex_);
    if (finalized_) return true;
    ComponentState wanted{};
    {
        const std::lock_guard lock(state_mutex_);
        wanted = component_state_;
    }
    follower_ = std::this_thread::get_id();
    const auto self = m_objref.in();
    if (state() == RTC::ERROR_STATE && wanted != ComponentState::error) context_->resetComponent(self);
    // With a fault the activation fails, which is the way from INACTIVE to ERROR.
    if (state() == RTC::INACTIVE_STATE && wanted != ComponentState::inactive)
        context_->activateComponent(self);
    if (state() == RTC::ACTIVE_STATE && wanted == ComponentState::inactive)
        context_->deactivateComponent(self);
    if (state() == RTC::ACTIVE_STATE && wanted == ComponentState::error)
        for (int cycle = 0; cycle < 2; ++cycle) context_->tick(); // one that fails and one that aborts
    follower_ = std::thread::id();
    const auto reached = state();
    if (wanted == ComponentState::error) return reached == RTC::ERROR_STATE;
    return reached == (wanted == ComponentState::active ? RTC::ACTIVE_STATE : RTC::INACTIVE_STATE);
}

/// Sends a life-cycle command to the component; logs one line if that fails.
bool OprosRtc::command(std::string_view command, std::chrono::milliseconds timeout) {
    const auto name = control::encode_string(source_.component.name);
    const auto bound = std::max(source_.call_timeout, timeout + std::chrono::seconds(1));
    const auto reply = source_.link->call({"", command, "", name}, bound);
    std::string error = reply.text();
    if (reply.status == CallStatus::ok) {
        try {
            remember(control::decode_state_report(reply.bytes));
            return true;
        } catch (const link::LinkError& damaged) {
            error = damaged.what();
        }
    } else if (reply.status == CallStatus::timeout) {
        error = fmt::format("no reply within {} ms", bound.count());
    } else if (link::peer_has_gone(reply.status)) {
        error = "the OPRoS host is not there";
    }
    spdlog::error("{}: cannot {} the OPRoS component: {}", getInstanceName(), command, error);
    return false;
}

RTC::ReturnCode_t OprosRtc::onActivated(RTC::UniqueId) {
    if (!is_following() && !command(control::activate, control::activation_timeout)) return RTC::RTC_ERROR;
    if (fault_) return RTC::RTC_ERROR;
    wake_pending_ = true;
    context_->tick(); // for what has come before the activation
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onDeactivated(RTC::UniqueId) {
    // Also called on the way to ERROR, where there is nothing to stop.
    if (!fault_ && must_tell_component()) command(control::deactivate, control::deactivation_timeout);
    return RTC::RTC_OK;
}

RTC::ReturnCode_t OprosRtc::onReset(RTC::UniqueId) {
    if (is_following()) return RTC::RTC_OK;
    return command(control::reset, control::deactivation_timeout) ? RTC::RTC_OK : RTC::RTC_ERROR;
}

RTC::ReturnCode_t OprosRtc::onExecute(RTC::UniqueId) {
    wake_pending_ = false;
    if (fault_) return RTC::RTC_ERROR;
    for (auto& output : outputs_) output.port->forward();
    return RTC::RTC_OK;
}

} // namespace tandem::interceptor
