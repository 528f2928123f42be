// SPDX-License-Identifier: Apache-2.0
// Names of components in other processes. Unlike OpenRTM-aist's, each call has a time limit, and an error says
// which of the parties on the way (name server, manager, component) did not answer.
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/local/local_endpoint.hpp"
#include "host/rtm/runtime/network/tls.hpp"
#include <chrono>
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/CorbaNaming.h>
#include <unistd.h>

namespace RTC {

RemoteName parse_remote_name(const std::string& name) {
    const std::size_t colon = name.find("://");
    if (colon == std::string::npos) return {"", "", name};
    const std::string rest = name.substr(colon + 3);
    const std::size_t slash = rest.find('/');
    return {coil::toLower(name.substr(0, colon)), rest.substr(0, slash),
            slash == std::string::npos ? "" : rest.substr(slash + 1)};
}

std::string with_default_port(const std::string& address, int port) {
    // Colons within brackets are those of an address of IPv6.
    const std::size_t bracket = address.rfind(']');
    const bool has_port = address.find(':', bracket == std::string::npos ? 0 : bracket) != std::string::npos;
    return has_port ? address : address + ":" + std::to_string(port);
}

// What omniORB's exceptions mean for calls to another process.
std::string describe_exception(const CORBA::Exception& e) {
    const std::string name = e._name();
    if (name == "TRANSIENT") return "no process listens there";
    if (name == "TIMEOUT") return "no answer in time";
    if (name == "OBJECT_NOT_EXIST") return "the object no longer exists";
    if (name == "NO_PERMISSION") return "its process does not permit it; the log there says why";
    if (name == "COMM_FAILURE") return "the connection was lost";
    return "CORBA exception " + name;
}

CosNaming::Name to_corba_name(const std::string& path) {
    const CosNaming::Name name = path.empty() ? CosNaming::Name() : CorbaNaming::toName(path.c_str());
    if (name.length() == 0) // a path of nothing but slashes has no parts either
        throw RemoteUnavailable("the name is empty; expected CONTEXT.host_cxt/NAME.rtc");
    return name;
}

namespace {

// The object of interface Interface at a corbaloc URL. `what` and `address` name it in messages.
template <class Interface>
typename Interface::_ptr_type resolve_by_key(CORBA::ORB_ptr orb, const std::string& url,
                                             const std::string& what, const std::string& address,
                                             unsigned long milliseconds) {
    std::string cause = "the object there is not a " + what;
    try {
        CORBA::Object_var object = orb->string_to_object(url.c_str());
        omniORB::setClientCallTimeout(object.in(), static_cast<CORBA::ULong>(milliseconds));
        typename Interface::_var_type narrowed = Interface::_narrow(object.in()); // calls the process
        if (!CORBA::is_nil(narrowed.in())) {
            // The time limit belongs to a reference; _narrow() makes another one.
            omniORB::setClientCallTimeout(narrowed.in(), static_cast<CORBA::ULong>(milliseconds));
            return narrowed._retn();
        }
    } catch (const CORBA::Exception& e) {
        cause = describe_exception(e);
    }
    throw RemoteUnavailable(what + " " + address + ": " + cause);
}

const std::string local_prefix = "unix:", own_manager = "unix:self";

// A process may have left a socket that another process with the same id did not remove. The socket that answers
// counts.
RTM::Manager_ptr resolve_local_manager(CORBA::ORB_ptr orb, const std::string& address,
                                       unsigned long milliseconds) {
    for (const auto& endpoint : tandem::local::find_local_endpoints(tandem::local::manager_endpoint))
        if (local_manager_address(endpoint.pid) == address &&
            tandem::local::accepts_connections(endpoint.socket))
            return resolve_by_key<RTM::Manager>(orb,
                                                "corbaloc:omniunix:" + endpoint.socket.native() + ":/manager",
                                                "manager", address, milliseconds);
    throw RemoteUnavailable("manager " + address + ": no process of this user with that number is a manager");
}

} // namespace

std::string local_manager_address(pid_t pid) { return local_prefix + std::to_string(pid); }

CosNaming::NamingContext_ptr resolve_name_server(CORBA::ORB_ptr orb, const std::string& address,
                                                 unsigned long milliseconds) {
    const std::string server = with_default_port(address, 2809);
    return resolve_by_key<CosNaming::NamingContext>(orb, "corbaloc:iiop:" + server + "/NameService",
                                                    "name server", server, milliseconds);
}

RTM::Manager_ptr resolve_manager(CORBA::ORB_ptr orb, const std::string& address, unsigned long milliseconds) {
    if (address == own_manager)
        return resolve_local_manager(orb, local_manager_address(getpid()), milliseconds);
    if (address.compare(0, local_prefix.size(), local_prefix) == 0)
        return resolve_local_manager(orb, address, milliseconds);
    const std::string manager = with_default_port(address, 2810);
    const std::string protocol = uses_tls() ? "ssliop" : "iiop";
    return resolve_by_key<RTM::Manager>(orb, "corbaloc:" + protocol + ":" + manager + "/manager", "manager",
                                        manager, milliseconds);
}

namespace {

// Narrows a reference that a server has given, and makes sure that the component exists: name servers keep
// names of processes that have ended.
RTObject_ptr require_component(CORBA::Object_ptr object, const std::string& name,
                               unsigned long milliseconds) {
    std::string cause = "the object of that name is not an RT-Component";
    try {
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(milliseconds));
        RTObject_var component = RTObject::_narrow(object);
        if (!CORBA::is_nil(component.in()) && !component->_non_existent()) return component._retn();
    } catch (const CORBA::Exception& e) {
        cause = describe_exception(e) + "; is the component's process running?";
    }
    throw RemoteUnavailable(name + ": " + cause);
}

// Collects all entries NAME.rtc in a context and below it. Contexts may contain each other, so the depth is
// bounded, and so is the number of entries of one context.
void find_entries(CosNaming::NamingContext_ptr context, const std::string& id, int max_depth,
                  std::vector<CORBA::Object_var>& found) {
    constexpr CORBA::ULong max_entries = 1000;
    CosNaming::BindingList_var entries;
    CosNaming::BindingIterator_var more;
    context->list(max_entries, entries.out(), more.out());
    if (!CORBA::is_nil(more.in())) more->destroy();
    for (CORBA::ULong i = 0; i < entries->length(); ++i) {
        const CosNaming::NameComponent& part = entries[i].binding_name[0];
        const bool is_context = entries[i].binding_type == CosNaming::ncontext;
        if (!is_context && (id != static_cast<const char*>(part.id) || std::string(part.kind) != "rtc"))
            continue;
        CORBA::Object_var object = context->resolve(entries[i].binding_name);
        if (!is_context) {
            found.push_back(object);
        } else if (max_depth > 0) {
            CosNaming::NamingContext_var next = CosNaming::NamingContext::_narrow(object.in());
            if (!CORBA::is_nil(next.in())) find_entries(next.in(), id, max_depth - 1, found);
        }
    }
}

// `path` is CONTEXT/NAME, with or without `.rtc`, or */NAME for an entry in any context.
RTObject_ptr resolve_by_name_server(CORBA::ORB_ptr orb, const std::string& server, const std::string& path,
                                    const std::string& name, unsigned long milliseconds) {
    CosNaming::NamingContext_var root = resolve_name_server(orb, server, milliseconds);
    try {
        if (path.compare(0, 2, "*/") == 0) {
            constexpr int max_depth = 4;
            std::vector<CORBA::Object_var> found;
            find_entries(root.in(), path.substr(2), max_depth, found);
            if (found.size() > 1)
                throw RemoteUnavailable(name + ": there are " + std::to_string(found.size()) +
                                        " components of that name; give the whole path");
            if (found.size() == 1) return require_component(found[0].in(), name, milliseconds);
        } else {
            const bool has_kind = path.size() > 4 && path.compare(path.size() - 4, 4, ".rtc") == 0;
            CORBA::Object_var object = root->resolve(to_corba_name(has_kind ? path : path + ".rtc"));
            return require_component(object.in(), name, milliseconds);
        }
    } catch (const CosNaming::NamingContext::NotFound&) {
        // reported below, as for a search without a result
    } catch (const CORBA::Exception& e) {
        throw RemoteUnavailable("name server " + server + ": " + describe_exception(e));
    }
    throw RemoteUnavailable(name + ": name server " + server + " has no such entry");
}

// `path` is NAME, CATEGORY/NAME or */NAME, as in RTM::Manager::get_components_by_name().
bool is_named(const ComponentProfile& profile, const std::string& path) {
    const std::size_t slash = path.find('/');
    const std::string category = slash == std::string::npos ? "*" : path.substr(0, slash);
    return path.substr(slash == std::string::npos ? 0 : slash + 1) ==
               static_cast<const char*>(profile.instance_name) &&
           (category == "*" || category == static_cast<const char*>(profile.category));
}

/// The components of a manager that have a name, and why one could not be asked for its name; empty if all have
/// answered.
struct NamedComponents {
    std::vector<RTObject_var> found;
    std::string not_answered; ///< for a component that is just ending, or whose process hangs
};

// Asks each component for its name. OpenRTM-aist 2.x's get_components_by_name() releases what it returns once
// too often, so that its process ends after ten calls; it must not be called.
NamedComponents find_named(RTM::Manager_ptr manager, const std::string& path, unsigned long milliseconds) {
    RTCList_var components = manager->get_components();
    NamedComponents named;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    for (CORBA::ULong i = 0; i < components->length() && std::chrono::steady_clock::now() < deadline; ++i) {
        try {
            omniORB::setClientCallTimeout(components[i], static_cast<CORBA::ULong>(milliseconds));
            ComponentProfile_var profile = components[i]->get_component_profile();
            if (is_named(profile.in(), path)) named.found.emplace_back(RTObject::_duplicate(components[i]));
        } catch (const CORBA::Exception& e) {
            named.not_answered = "; one of its components could not be asked: " + describe_exception(e);
        }
    }
    return named;
}

RTObject_ptr resolve_by_manager(CORBA::ORB_ptr orb, const RemoteName& parsed, const std::string& name,
                                unsigned long milliseconds) {
    RTM::Manager_var manager = resolve_manager(orb, parsed.address, milliseconds);
    NamedComponents named;
    try {
        named = find_named(manager.in(), parsed.path, milliseconds);
        if (named.found.empty()) {
            const std::string instance = parsed.path.substr(parsed.path.find('/') + 1);
            for (const auto& creation : components_being_created(manager.in()))
                if (creation.instance == instance) throw ComponentBeingCreated(name, creation);
            // The creation may have ended between the two calls.
            named = find_named(manager.in(), parsed.path, milliseconds);
        }
    } catch (const CORBA::Exception& e) {
        throw RemoteUnavailable("manager " + parsed.address + ": " + describe_exception(e));
    }
    auto& found = named.found;
    if (found.size() == 1) return found.front()._retn();
    throw RemoteUnavailable(
        name + ": the manager there has " +
        (found.empty() ? "no such component" + named.not_answered
                       : std::to_string(found.size()) + " components of that name; give the category, too"));
}

} // namespace

RTObject_ptr resolve_component(CORBA::ORB_ptr orb, const std::string& name,
                               const std::vector<std::string>& servers, unsigned long milliseconds) {
    const RemoteName parsed = parse_remote_name(name);
    if (parsed.path.empty() || parsed.address.empty())
        throw InvalidRemoteName("`" + name + "` is not a name of a component; expected " +
                                "rtcname://HOST:PORT/PATH/NAME or rtcloc://HOST:PORT/NAME");
    if (parsed.scheme == "rtcloc") return resolve_by_manager(orb, parsed, name, milliseconds);
    if (parsed.scheme != "rtcname")
        throw InvalidRemoteName("`" + name + "`: unknown scheme " + parsed.scheme +
                                "; expected rtcname or rtcloc");
    if (parsed.address != "*")
        return resolve_by_name_server(orb, parsed.address, parsed.path, name, milliseconds);
    std::string cause = name + ": no name server is configured; set corba.nameservers";
    for (const auto& server : servers) {
        try {
            return resolve_by_name_server(orb, server, parsed.path, name, milliseconds);
        } catch (const RemoteUnavailable& e) {
            cause = e.what(); // the next server may know it
        }
    }
    throw RemoteUnavailable(cause);
}

} // namespace RTC
