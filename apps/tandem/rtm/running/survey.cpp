// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/survey.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

namespace tandem::command {
namespace {

Seen look_at(const std::string& address, CORBA::Object_ptr object, unsigned long call_ms) {
    Seen seen;
    seen.address = address;
    try {
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(call_ms));
        seen.object = RTC::RTObject::_narrow(object);
        if (CORBA::is_nil(seen.object.in())) {
            seen.trouble = "it is no RT-Component";
            return seen;
        }
        RTC::ComponentProfile_var profile = seen.object->get_component_profile();
        seen.instance = profile->instance_name;
        seen.type = profile->type_name;
        seen.category = profile->category;
        seen.ports = profile->port_profiles.length();
        seen.state = state_of(seen.object.in());
    } catch (const CORBA::Exception& e) {
        seen.trouble = RTC::describe_exception(e);
    }
    return seen;
}

// Contexts may contain each other: `depth` bounds it.
void walk(CosNaming::NamingContext_ptr context, const std::string& path, int depth, unsigned long call_ms,
          std::vector<Seen>& out) {
    CosNaming::BindingList_var list;
    CosNaming::BindingIterator_var more;
    context->list(10000, list.out(), more.out());
    if (!CORBA::is_nil(more.in())) more->destroy();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        const CosNaming::NameComponent& last = list[i].binding_name[0];
        const std::string kind(last.kind);
        const std::string name =
            path + "/" + static_cast<const char*>(last.id) + (kind.empty() ? "" : "." + kind);
        if (list[i].binding_type == CosNaming::nobject && kind != "rtc") continue;
        CORBA::Object_var object = context->resolve(list[i].binding_name);
        if (list[i].binding_type == CosNaming::nobject) {
            out.push_back(look_at(name, object.in(), call_ms));
        } else if (depth > 0) {
            CosNaming::NamingContext_var next = CosNaming::NamingContext::_narrow(object.in());
            if (!CORBA::is_nil(next.in())) walk(next.in(), name, depth - 1, call_ms, out);
        }
    }
}

template <class Look>
Place place(const char* kind, const std::string& address, Look look) {
    Place place{kind, address, "", {}};
    try {
        look(place);
    } catch (const RTC::RemoteUnavailable& e) {
        place.trouble = e.what();
    } catch (const CORBA::Exception& e) {
        place.trouble = std::string(kind) + " " + address + ": " + RTC::describe_exception(e);
    }
    return place;
}

} // namespace

std::vector<Place> survey(const Peers& peers) {
    std::vector<Place> places;
    for (const auto& address : peers.name_servers())
        places.push_back(place("name server", address, [&](Place& p) {
            CosNaming::NamingContext_var root =
                RTC::resolve_name_server(peers.orb(), address, peers.call_ms());
            walk(root.in(), "rtcname://" + address, 6, peers.call_ms(), p.components);
        }));
    for (const auto& address : peers.managers())
        places.push_back(place("manager", address, [&](Place& p) {
            RTM::Manager_var manager = RTC::resolve_manager(peers.orb(), address, peers.call_ms());
            RTC::RTCList_var components = manager->get_components();
            for (CORBA::ULong i = 0; i < components->length(); ++i) {
                p.components.push_back(look_at("", components[i], peers.call_ms()));
                p.components.back().address = "rtcloc://" + address + "/" + p.components.back().instance;
            }
        }));
    return places;
}

void require_answers(const Peers& peers, const std::vector<Place>& places) {
    std::string troubles;
    bool answered = false;
    for (const auto& place : places) {
        answered = answered || place.trouble.empty();
        if (!place.trouble.empty()) troubles += (troubles.empty() ? "" : "; ") + place.trouble;
    }
    if (!answered && peers.managers().empty()) troubles += "; none of your processes here is a manager";
    if (!answered) troubles += "; start rtm_host or omniNames, or name one with --nameserver or --manager";
    if (!troubles.empty() && (peers.named() || !answered)) throw std::runtime_error(troubles);
}

} // namespace tandem::command
