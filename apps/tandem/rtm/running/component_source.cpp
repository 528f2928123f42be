// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/component_source.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

#include <algorithm>

namespace tandem::command {
namespace {

// Returns a component's answers about itself. A failure becomes the entry's error and does not end the listing, because
// name servers often contain names of dead processes.
ComponentEntry query_component(const std::string& address, CORBA::Object_ptr object,
                               unsigned long timeout_ms) {
    ComponentEntry entry;
    entry.address = address;
    try {
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(timeout_ms));
        // This is a remote call if the reference does not contain the type RTObject itself.
        entry.object = RTC::RTObject::_narrow(object);
        if (CORBA::is_nil(entry.object.in())) {
            entry.error = "it is not an RT-Component";
            return entry;
        }
        RTC::ComponentProfile_var profile = entry.object->get_component_profile();
        entry.instance = profile->instance_name;
        entry.type = profile->type_name;
        entry.category = profile->category;
        entry.ports = profile->port_profiles.length();
        entry.state = component_state(entry.object.in());
        RTC::ExecutionContextList_var own = entry.object->get_owned_contexts();
        if (own->length() > 0) entry.callback = ContextInfo(own[0]).describe_running_callback(entry.instance);
    } catch (const CORBA::Exception& e) {
        entry.error = RTC::describe_exception(e);
    }
    return entry;
}

// Adds the components below a naming context. `depth` bounds the recursion, because contexts may form a cycle.
// OpenRTM-aist binds components with the kind "rtc"; other objects are not components.
void list_context(CosNaming::NamingContext_ptr context, const std::string& path, int depth,
                  unsigned long timeout_ms, std::vector<ComponentEntry>& out) {
    CosNaming::BindingList_var list;
    CosNaming::BindingIterator_var more;
    context->list(10000, list.out(), more.out());
    // Lists only the first 10000 names. The name server keeps the iterator over the rest until it is destroyed.
    if (!CORBA::is_nil(more.in())) more->destroy();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        // list() returns names relative to the context, with one component each (CosNaming, NamingContext::list).
        const CosNaming::NameComponent& last = list[i].binding_name[0];
        const std::string kind(last.kind);
        const std::string name =
            path + "/" + static_cast<const char*>(last.id) + (kind.empty() ? "" : "." + kind);
        if (list[i].binding_type == CosNaming::nobject && kind != "rtc") continue;
        CORBA::Object_var object = context->resolve(list[i].binding_name);
        if (list[i].binding_type == CosNaming::nobject) {
            out.push_back(query_component(name, object.in(), timeout_ms));
        } else if (depth > 0) {
            CosNaming::NamingContext_var next = CosNaming::NamingContext::_narrow(object.in());
            if (!CORBA::is_nil(next.in())) list_context(next.in(), name, depth - 1, timeout_ms, out);
        }
    }
}

// A component under creation does not answer calls yet.
std::vector<ComponentEntry> entries_being_created(RTM::Manager_ptr manager) {
    std::vector<ComponentEntry> entries;
    for (const auto& creation : RTC::components_being_created(manager)) {
        ComponentEntry entry;
        entry.instance = creation.instance;
        entry.type = creation.type;
        entry.state = "CREATED"; // until initialize() returns (RTC specification, LifeCycleState)
        entry.callback = creation.text();
        entries.push_back(std::move(entry));
    }
    return entries;
}

// Runs `query` and stores its failure as the source's error, so that other sources are still queried. Keeps components
// that `query` added before the failure.
template <class Query>
ComponentSource query_source(const char* kind, const std::string& address, Query query) {
    ComponentSource source{kind, address, "", {}};
    try {
        query(source);
    } catch (const RTC::RemoteUnavailable& e) {
        source.error = e.what();
    } catch (const CORBA::Exception& e) {
        source.error = std::string(kind) + " " + address + ": " + RTC::describe_exception(e);
    }
    return source;
}

} // namespace

std::vector<ComponentSource> enumerate_components(const RtmClient& client) {
    std::vector<ComponentSource> sources;
    for (const auto& address : client.name_servers())
        sources.push_back(query_source("name server", address, [&](ComponentSource& p) {
            CosNaming::NamingContext_var root =
                RTC::resolve_name_server(client.orb(), address, client.timeout_ms());
            // OpenRTM-aist's default name, %h.host_cxt/%n.rtc, is one context deep; naming.formats may add more.
            list_context(root.in(), "rtcname://" + address, 6, client.timeout_ms(), p.components);
        }));
    for (const auto& address : client.managers())
        sources.push_back(query_source("manager", address, [&](ComponentSource& p) {
            RTM::Manager_var manager = RTC::resolve_manager(client.orb(), address, client.timeout_ms());
            // Queried first, so that a component that becomes ready meanwhile is in both answers instead of in none.
            const auto being_created = entries_being_created(manager.in());
            RTC::RTCList_var components = manager->get_components();
            for (CORBA::ULong i = 0; i < components->length(); ++i) {
                p.components.push_back(query_component("", components[i], client.timeout_ms()));
            }
            for (const auto& entry : being_created)
                if (std::none_of(p.components.begin(), p.components.end(),
                                 [&](const auto& listed) { return listed.instance == entry.instance; }))
                    p.components.push_back(entry);
            // A manager finds components by instance name, which is unknown for a component that does not answer.
            for (auto& entry : p.components) entry.address = "rtcloc://" + address + "/" + entry.instance;
        }));
    return sources;
}

void throw_if_sources_failed(const RtmClient& client, const std::vector<ComponentSource>& sources) {
    // Without explicit sources, one answer suffices, because a machine need not run a name server.
    std::string errors;
    bool answered = false;
    for (const auto& source : sources) {
        answered = answered || source.error.empty();
        if (!source.error.empty()) errors += (errors.empty() ? "" : "; ") + source.error;
    }
    if (!answered && client.managers().empty())
        errors += "; none of your processes on this machine is a manager";
    if (!answered) errors += "; start rtm_host or omniNames, or name one with --nameserver or --manager";
    if (!errors.empty() && (client.has_explicit_sources() || !answered)) throw std::runtime_error(errors);
}

} // namespace tandem::command
