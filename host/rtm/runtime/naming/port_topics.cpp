// SPDX-License-Identifier: Apache-2.0
// The names in a name server are those of OpenRTM-aist, so that its managers connect with ours.
#include "host/rtm/runtime/naming/port_topics.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include <rtm/CORBA_RTCUtil.h>
#include <rtm/PortBase.h>

namespace RTC {
namespace {

/// How ports of one type name their topic, and where the topic is in a name server.
struct TopicKind {
    const char *port_type, *property;   // of a port's profile
    const char *context, *context_kind; // CONTEXT/TOPIC.CONTEXT_KIND
    const char *kind, *peer_kind;       // of the names of the ports there
};

constexpr TopicKind topic_kinds[] = {
    {"DataOutPort", "publish_topic", "dataports.port_cxt", "topic_cxt", "outport", "inport"},
    {"DataInPort", "subscribe_topic", "dataports.port_cxt", "topic_cxt", "inport", "outport"},
    {"CorbaPort", "rendezvous_point", "svcports.port_cxt", "svc_cxt", "svc", "svc"},
};

constexpr CORBA::ULong timeout_ms = 2000;

const TopicKind* find_topic_kind(const std::string& port_type) {
    for (const auto& kind : topic_kinds)
        if (port_type == kind.port_type) return &kind;
    return nullptr;
}

// A port that names its topic by the property of another type would stay alone without notice.
void warn_about_other_properties(const PortProfile& profile, const TopicKind& kind,
                                 std::vector<std::string>& lines) {
    for (const auto& other : topic_kinds)
        if (&other != &kind && !NVUtil::toString(profile.properties, other.property).empty())
            lines.push_back(std::string(profile.name) + ": " + other.property + " has no effect at a " +
                            kind.port_type + "; set " + kind.property);
}

// Returns an empty string for this machine.
std::string machine_of(PortService_ptr port) {
    const std::string address = address_on_another_machine(port);
    return address.substr(0, address.rfind(':')); // without the number of the TCP port
}

// Collects the ports of one kind that a name server lists in a context. Names of processes that have ended may be among
// them.
std::vector<PortService_var> published_ports(CORBA::ORB_ptr orb, const std::string& server,
                                             const std::string& context, const std::string& kind) {
    constexpr CORBA::ULong max_entries = 1000;
    std::vector<PortService_var> found;
    CosNaming::NamingContext_var root = resolve_name_server(orb, server);
    CORBA::Object_var object = root->resolve(to_corba_name(context));
    omniORB::setClientCallTimeout(object.in(), timeout_ms);
    CosNaming::NamingContext_var topic = CosNaming::NamingContext::_narrow(object.in());
    if (CORBA::is_nil(topic.in())) return found;
    omniORB::setClientCallTimeout(topic.in(), timeout_ms); // _narrow() makes another reference
    CosNaming::BindingList_var entries;
    CosNaming::BindingIterator_var more;
    topic->list(max_entries, entries.out(), more.out());
    if (!CORBA::is_nil(more.in())) more->destroy();
    for (CORBA::ULong i = 0; i < entries->length(); ++i) {
        if (kind != static_cast<const char*>(entries[i].binding_name[0].kind)) continue;
        try {
            CORBA::Object_var port = topic->resolve(entries[i].binding_name);
            found.emplace_back(PortService::_unchecked_narrow(port.in()));
        } catch (const CosNaming::NamingContext::NotFound&) {
            continue; // unbound since list()
        }
    }
    return found;
}

} // namespace

// Without the ports that a composite shows as its own: they belong to its members.
std::vector<PortTopics::TopicPort> PortTopics::find_topics(RTObject_ptr component,
                                                           std::vector<std::string>& lines) {
    std::vector<TopicPort> found;
    PortServiceList_var ports = component->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        PortProfile_var profile = ports[i]->get_port_profile();
        const TopicKind* kind = find_topic_kind(NVUtil::toString(profile->properties, "port.port_type"));
        if (kind == nullptr || !component->_is_equivalent(profile->owner)) continue;
        warn_about_other_properties(profile.in(), *kind, lines);
        const std::string topic = NVUtil::toString(profile->properties, kind->property);
        if (topic.empty()) continue;
        found.push_back({std::string(kind->context) + "/" + topic + "." + kind->context_kind, kind->kind,
                         kind->peer_kind, static_cast<const char*>(profile->name),
                         PortService::_duplicate(ports[i]), RTObject::_duplicate(component)});
    }
    return found;
}

std::vector<PortTopics::TopicPort> PortTopics::ports() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return ports_;
}

std::vector<std::string> PortTopics::add(RTObject_ptr component) {
    std::vector<std::string> lines;
    const auto added = find_topics(component, lines);
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ports_.insert(ports_.end(), added.begin(), added.end());
    }
    for (const auto& own : added)
        for (auto& error : bindings_.bind(own.path(), own.port.in())) lines.push_back(std::move(error));
    Search search{lines};
    for (const auto& own : added) connect(own, search);
    return lines;
}

void PortTopics::remove(RTObject_ptr component) {
    std::vector<std::string> paths;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        for (const auto& own : ports_)
            if (own.owner->_is_equivalent(component)) paths.push_back(own.path());
        std::erase_if(ports_, [&](const auto& own) { return own.owner->_is_equivalent(component); });
    }
    for (const auto& path : paths) bindings_.unbind(path);
}

std::vector<std::string> PortTopics::connect_all() {
    std::vector<std::string> lines;
    Search search{lines};
    for (const auto& own : ports()) connect(own, search);
    return lines;
}

void PortTopics::connect(const TopicPort& own, Search& search) const {
    for (const auto& other : ports())
        if (other.context == own.context && other.kind == own.peer_kind)
            connect(own, other.port.in(), search);
    for (const auto& server : bindings_.reachable_servers()) {
        try {
            connect_published(own, server, search);
        } catch (const RemoteUnavailable&) {
            continue; // bind() has reported it
        } catch (const CORBA::Exception&) {
            continue; // no port of that topic is in this server yet
        }
    }
}

// Throws RemoteUnavailable or CORBA::Exception if the server does not list the topic.
void PortTopics::connect_published(const TopicPort& own, const std::string& server, Search& search) const {
    for (const auto& other : published_ports(orb_.in(), server, own.context, own.peer_kind)) {
        if (std::chrono::steady_clock::now() > search.end) {
            search.lines.push_back(own.name + ": name server " + server +
                                   " lists ports of its topic that do not answer; the rest are left out");
            return;
        }
        if (!search.silent_machines.contains(machine_of(other.in()))) connect(own, other.in(), search);
    }
}

// The other process may look for ports at the same time, and one of the two attempts finds the other's connection.
void PortTopics::connect(const TopicPort& own, PortService_ptr other, Search& search) {
    const auto port = local_object<PortBase>(own.port.in());
    if (!port || own.port->_is_equivalent(other)) return;
    try {
        if (CORBA_RTCUtil::already_connected(own.port.in(), other)) return;
        if (local_object<PortBase>(other) == nullptr) omniORB::setClientCallTimeout(other, timeout_ms);
        PortProfile_var profile = other->get_port_profile();
        const std::string other_name(profile->name);
        ConnectorProfile_var connector = CORBA_RTCUtil::create_connector(
            own.name + ":" + other_name, coil::Properties(), own.port.in(), other);
        if (port->connect(connector.inout()) != RTC_OK &&
            !CORBA_RTCUtil::already_connected(own.port.in(), other))
            search.lines.push_back(own.name + " and " + other_name +
                                   " name one topic, and cannot be connected: " + port->connectError());
    } catch (const CORBA::TIMEOUT&) {
        if (const auto machine = machine_of(other); !machine.empty()) search.silent_machines.insert(machine);
    } catch (const CORBA::SystemException&) {
        return; // its process has ended; a name server keeps names
    }
}

} // namespace RTC
