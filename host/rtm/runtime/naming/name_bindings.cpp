// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <algorithm>

namespace RTC {
namespace {

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

void bind_path(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    const CosNaming::Name name = to_corba_name(path);
    make_contexts(root, name);
    root->rebind(name, object);
}

enum class Binding { ours, foreign, missing, context_missing };

Binding query_binding(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    try {
        CORBA::Object_var present = root->resolve(to_corba_name(path));
        return present->_is_equivalent(object) ? Binding::ours : Binding::foreign;
    } catch (const CosNaming::NamingContext::NotFound& e) {
        // A server that does not even know our host's context has lost its entries: nobody unbinds contexts.
        const bool first = e.rest_of_name.length() == to_corba_name(path).length();
        return first && e.rest_of_name.length() > 1 ? Binding::context_missing : Binding::missing;
    }
}

} // namespace

NameBindings::NameBindings(CORBA::ORB_ptr orb, const std::vector<std::string>& servers)
    : orb_(CORBA::ORB::_duplicate(orb)) {
    for (const auto& server : servers) servers_.push_back({with_default_port(server, 2809), true});
}

void NameBindings::add_server(const std::string& server) {
    const std::string address = with_default_port(server, 2809);
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& present : servers_)
        if (present.address == address) return;
    servers_.push_back({address, true});
}

std::vector<NameBindings::Entry> NameBindings::entries() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return entries_;
}

std::vector<std::string> NameBindings::servers() const {
    std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::string> addresses;
    for (const auto& server : servers_) addresses.push_back(server.address);
    return addresses;
}

void NameBindings::set_reachable(const std::string& address, bool reachable) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto& server : servers_)
        if (server.address == address) server.reachable = reachable;
}

std::vector<std::string> NameBindings::bind(const std::string& path, CORBA::Object_ptr object) {
    std::vector<Server> servers;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        std::erase_if(entries_, [&](const Entry& entry) { return entry.path == path; });
        entries_.push_back({path, CORBA::Object::_duplicate(object)});
        servers = servers_;
    }
    std::vector<std::string> refusals;
    for (const auto& server : servers) {
        if (!server.reachable) continue; // was said when it went
        try {
            CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
            bind_path(root.in(), path, object);
        } catch (const RemoteUnavailable& e) {
            set_reachable(server.address, false);
            refusals.push_back(
                std::string(e.what()) +
                "; names are bound when it comes; start omniNames there or set naming.enable: NO");
        } catch (const CORBA::Exception& e) {
            refusals.push_back("name server " + server.address + " does not take " + path + " (" + e._name() +
                               ")");
        }
    }
    return refusals;
}

void NameBindings::unbind(const std::string& path) {
    CORBA::Object_var object;
    std::vector<Server> servers;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        for (const auto& entry : entries_)
            if (entry.path == path) object = entry.object;
        std::erase_if(entries_, [&](const Entry& entry) { return entry.path == path; });
        servers = servers_;
    }
    if (CORBA::is_nil(object.in())) return;
    for (const auto& server : servers) {
        if (!server.reachable) continue;
        try {
            CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
            if (query_binding(root.in(), path, object.in()) == Binding::ours)
                root->unbind(to_corba_name(path));
        } catch (const RemoteUnavailable&) {
            set_reachable(server.address, false); // its entries are gone with it, or stale
        } catch (const CORBA::Exception&) {
            continue; // somebody else has removed the entry just now
        }
    }
}

std::vector<std::string> NameBindings::update(bool rebind) {
    std::vector<Server> servers;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        servers = servers_;
    }
    std::vector<std::string> news;
    for (const auto& server : servers) {
        std::string line;
        try {
            line = update(server, rebind);
        } catch (const RemoteUnavailable& e) {
            if (server.reachable) line = std::string(e.what()) + "; names are bound again when it is back";
            set_reachable(server.address, false);
        } catch (const CORBA::Exception& e) {
            line = "name server " + server.address + " does not take our names (" + e._name() + ")";
        }
        if (!line.empty()) news.push_back(line);
    }
    return news;
}

std::string NameBindings::update(const Server& server, bool rebind) {
    const auto all = entries();
    CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
    std::vector<Entry> missing;
    bool contexts_lost = false;
    for (const auto& entry : all) {
        const Binding found = query_binding(root.in(), entry.path, entry.object.in());
        // What another process has taken since is left to it, as long as the server was there.
        if (found != Binding::ours && !(found == Binding::foreign && server.reachable))
            missing.push_back(entry);
        contexts_lost = contexts_lost || found == Binding::context_missing;
    }
    set_reachable(server.address, true);
    if (missing.empty() || (server.reachable && !contexts_lost && !rebind)) return "";
    for (const auto& entry : missing) bind_path(root.in(), entry.path, entry.object.in());
    return "name server " + server.address + ": bound " + std::to_string(missing.size()) + " name" +
           (missing.size() == 1 ? "" : "s") + " again";
}

} // namespace RTC
