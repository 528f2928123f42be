// SPDX-License-Identifier: Apache-2.0
#include "naming.hpp"
#include <coil/stringutil.h>
#include <omniORB4/Naming.hh>

namespace RTC {
namespace {

// a.x/b.y -> {{a, x}, {b, y}}
CosNaming::Name parsed(const std::string& path) {
    const auto parts = coil::split(path, "/", true);
    CosNaming::Name name;
    name.length(static_cast<CORBA::ULong>(parts.size()));
    for (CORBA::ULong i = 0; i < name.length(); ++i) {
        const std::size_t dot = parts[i].rfind('.');
        name[i].id = CORBA::string_dup(parts[i].substr(0, dot).c_str());
        name[i].kind = CORBA::string_dup(dot == std::string::npos ? "" : parts[i].substr(dot + 1).c_str());
    }
    return name;
}

CosNaming::NamingContext_ptr root_of(CORBA::ORB_ptr orb, const std::string& server) {
    const std::string address = server.find(':') == std::string::npos ? server + ":2809" : server;
    CORBA::Object_var object = orb->string_to_object(("corbaloc:iiop:" + address + "/NameService").c_str());
    return CosNaming::NamingContext::_narrow(object.in());
}

void make_contexts(CosNaming::NamingContext_ptr root, const CosNaming::Name& name) {
    for (CORBA::ULong depth = 1; depth < name.length(); ++depth) {
        CosNaming::Name prefix(name);
        prefix.length(depth);
        try {
            CosNaming::NamingContext_var made = root->bind_new_context(prefix);
        } catch (const CosNaming::NamingContext::AlreadyBound&) {
            continue;
        }
    }
}

} // namespace

Naming::Naming(CORBA::ORB_ptr orb, std::vector<std::string> servers)
    : orb_(CORBA::ORB::_duplicate(orb)), servers_(std::move(servers)) {}

std::vector<std::string> Naming::bind(const std::string& path, CORBA::Object_ptr object) {
    std::vector<std::string> refusals;
    const CosNaming::Name name = parsed(path);
    for (const auto& server : servers_) {
        try {
            CosNaming::NamingContext_var root = root_of(orb_.in(), server);
            if (CORBA::is_nil(root.in())) throw CORBA::OBJECT_NOT_EXIST();
            make_contexts(root.in(), name);
            root->rebind(name, object);
        } catch (const CORBA::Exception& e) {
            refusals.push_back("name server " + server + " does not take " + path + " (" + e._name() +
                               "); start omniNames there or set naming.enable: NO");
        }
    }
    return refusals;
}

void Naming::unbind(const std::string& path) {
    const CosNaming::Name name = parsed(path);
    for (const auto& server : servers_) {
        try {
            CosNaming::NamingContext_var root = root_of(orb_.in(), server);
            if (!CORBA::is_nil(root.in())) root->unbind(name);
        } catch (const CORBA::Exception&) {
            continue; // the server is gone, or somebody else has removed the entry
        }
    }
}

} // namespace RTC
