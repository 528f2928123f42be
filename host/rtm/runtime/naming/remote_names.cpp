// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>

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
    return address.find(':') == std::string::npos ? address + ":" + std::to_string(port) : address;
}

std::string describe_exception(const CORBA::Exception& e) {
    const std::string name = e._name();
    if (name == "TRANSIENT") return "nobody listens there";
    if (name == "TIMEOUT") return "no answer in time";
    if (name == "OBJECT_NOT_EXIST") return "it is gone";
    if (name == "COMM_FAILURE") return "the connection broke";
    return "CORBA exception " + name;
}

CosNaming::Name to_corba_name(const std::string& path) {
    const auto parts = coil::split(path, "/", true);
    if (parts.empty()) throw RemoteUnavailable("an empty name; expected CONTEXT.host_cxt/NAME.rtc");
    CosNaming::Name name;
    name.length(static_cast<CORBA::ULong>(parts.size()));
    for (CORBA::ULong i = 0; i < name.length(); ++i) {
        const std::size_t dot = parts[i].rfind('.');
        name[i].id = CORBA::string_dup(parts[i].substr(0, dot).c_str());
        name[i].kind = CORBA::string_dup(dot == std::string::npos ? "" : parts[i].substr(dot + 1).c_str());
    }
    return name;
}

CosNaming::NamingContext_ptr resolve_name_server(CORBA::ORB_ptr orb, const std::string& address,
                                                 unsigned long milliseconds) {
    const std::string where = with_default_port(address, 2809);
    std::string why = "it is no name server";
    try {
        CORBA::Object_var object = orb->string_to_object(("corbaloc:iiop:" + where + "/NameService").c_str());
        omniORB::setClientCallTimeout(object.in(), static_cast<CORBA::ULong>(milliseconds));
        CosNaming::NamingContext_var root = CosNaming::NamingContext::_narrow(object.in());
        if (!CORBA::is_nil(root.in())) {
            omniORB::setClientCallTimeout(root.in(), static_cast<CORBA::ULong>(milliseconds));
            return root._retn();
        }
    } catch (const CORBA::Exception& e) {
        why = describe_exception(e);
    }
    throw RemoteUnavailable("name server " + where + ": " + why);
}

RTM::Manager_ptr resolve_manager(CORBA::ORB_ptr orb, const std::string& address, unsigned long milliseconds) {
    const std::string where = with_default_port(address, 2810);
    std::string why = "it is no manager";
    try {
        CORBA::Object_var object = orb->string_to_object(("corbaloc:iiop:" + where + "/manager").c_str());
        omniORB::setClientCallTimeout(object.in(), static_cast<CORBA::ULong>(milliseconds));
        RTM::Manager_var manager = RTM::Manager::_narrow(object.in());
        if (!CORBA::is_nil(manager.in())) {
            omniORB::setClientCallTimeout(manager.in(), static_cast<CORBA::ULong>(milliseconds));
            return manager._retn();
        }
    } catch (const CORBA::Exception& e) {
        why = describe_exception(e);
    }
    throw RemoteUnavailable("manager " + where + ": " + why);
}

namespace {

RTObject_ptr answered(CORBA::Object_ptr object, const std::string& name, unsigned long milliseconds) {
    std::string why = "it is no RT-Component";
    try {
        omniORB::setClientCallTimeout(object, static_cast<CORBA::ULong>(milliseconds));
        RTObject_var component = RTObject::_narrow(object);
        if (!CORBA::is_nil(component.in()) && !component->_non_existent()) return component._retn();
    } catch (const CORBA::Exception& e) {
        why = describe_exception(e) + "; is its process alive?";
    }
    throw RemoteUnavailable(name + ": " + why);
}

// All entries NAME.rtc below a context; `depth` bounds contexts that contain each other.
void search(CosNaming::NamingContext_ptr context, const std::string& wanted, int depth,
            std::vector<CORBA::Object_var>& found) {
    CosNaming::BindingList_var list;
    CosNaming::BindingIterator_var more;
    context->list(1000, list.out(), more.out());
    if (!CORBA::is_nil(more.in())) more->destroy();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
        const CosNaming::NameComponent& last = list[i].binding_name[0];
        const bool is_context = list[i].binding_type == CosNaming::ncontext;
        if (!is_context && (wanted != static_cast<const char*>(last.id) || std::string(last.kind) != "rtc"))
            continue;
        CORBA::Object_var object = context->resolve(list[i].binding_name);
        if (!is_context) {
            found.push_back(object);
        } else if (depth > 0) {
            CosNaming::NamingContext_var next = CosNaming::NamingContext::_narrow(object.in());
            if (!CORBA::is_nil(next.in())) search(next.in(), wanted, depth - 1, found);
        }
    }
}

RTObject_ptr by_name_server(CORBA::ORB_ptr orb, const std::string& server, const std::string& path,
                            const std::string& name, unsigned long milliseconds) {
    CosNaming::NamingContext_var root = resolve_name_server(orb, server, milliseconds);
    try {
        if (path.compare(0, 2, "*/") == 0) {
            std::vector<CORBA::Object_var> found;
            search(root.in(), path.substr(2), 4, found);
            if (found.size() > 1)
                throw RemoteUnavailable(name + ": there are " + std::to_string(found.size()) +
                                        " of that name; give the whole path");
            if (found.size() == 1) return answered(found[0].in(), name, milliseconds);
        } else {
            const bool has_kind = path.size() > 4 && path.compare(path.size() - 4, 4, ".rtc") == 0;
            CORBA::Object_var object = root->resolve(to_corba_name(has_kind ? path : path + ".rtc"));
            return answered(object.in(), name, milliseconds);
        }
    } catch (const CosNaming::NamingContext::NotFound&) {
        // said below
    } catch (const CORBA::Exception& e) {
        throw RemoteUnavailable("name server " + server + ": " + describe_exception(e));
    }
    throw RemoteUnavailable(name + ": name server " + server + " has no such entry");
}

RTObject_ptr by_manager(CORBA::ORB_ptr orb, const RemoteName& parsed, const std::string& name,
                        unsigned long milliseconds) {
    RTM::Manager_var manager = resolve_manager(orb, parsed.address, milliseconds);
    try {
        RTCList_var found = manager->get_components_by_name(parsed.path.c_str());
        if (found->length() == 1) return answered(found[0], name, milliseconds);
        throw RemoteUnavailable(name + ": that manager has " +
                                (found->length() == 0
                                     ? "no such component"
                                     : std::to_string(found->length()) + " components of that name"));
    } catch (const CORBA::Exception& e) {
        throw RemoteUnavailable("manager " + parsed.address + ": " + describe_exception(e));
    }
}

} // namespace

RTObject_ptr resolve_component(CORBA::ORB_ptr orb, const std::string& name,
                               const std::vector<std::string>& servers, unsigned long milliseconds) {
    const RemoteName parsed = parse_remote_name(name);
    if (parsed.path.empty() || parsed.address.empty())
        throw RemoteUnavailable("`" + name +
                                "`; expected rtcname://HOST:PORT/PATH/NAME or rtcloc://HOST:PORT/NAME");
    if (parsed.scheme == "rtcloc") return by_manager(orb, parsed, name, milliseconds);
    if (parsed.scheme != "rtcname")
        throw RemoteUnavailable("`" + name + "`: scheme " + parsed.scheme +
                                " is unknown; expected rtcname or rtcloc");
    if (parsed.address != "*") return by_name_server(orb, parsed.address, parsed.path, name, milliseconds);
    std::string why = name + ": no name server is configured (corba.nameservers)";
    for (const auto& server : servers) {
        try {
            return by_name_server(orb, server, parsed.path, name, milliseconds);
        } catch (const RemoteUnavailable& e) {
            why = e.what();
        }
    }
    throw RemoteUnavailable(why);
}

} // namespace RTC
