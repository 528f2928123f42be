// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/naming/naming.hpp"
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

void bind_in(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    const CosNaming::Name name = to_name(path);
    make_contexts(root, name);
    root->rebind(name, object);
}

enum class Found { ours, other, missing, nothing_at_all };

Found look_up(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    try {
        CORBA::Object_var present = root->resolve(to_name(path));
        return present->_is_equivalent(object) ? Found::ours : Found::other;
    } catch (const CosNaming::NamingContext::NotFound& e) {
        // A server that does not even know our host's context has lost its entries: nobody unbinds contexts.
        const bool first = e.rest_of_name.length() == to_name(path).length();
        return first && e.rest_of_name.length() > 1 ? Found::nothing_at_all : Found::missing;
    }
}

} // namespace

Naming::Naming(CORBA::ORB_ptr orb, const std::vector<std::string>& servers)
    : orb_(CORBA::ORB::_duplicate(orb)) {
    for (const auto& server : servers) servers_.push_back({with_port(server, 2809), true});
}

void Naming::add_server(const std::string& server) {
    const std::string address = with_port(server, 2809);
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& present : servers_)
        if (present.address == address) return;
    servers_.push_back({address, true});
}

std::vector<Naming::Entry> Naming::entries() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return entries_;
}

std::vector<std::string> Naming::servers() const {
    std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::string> addresses;
    for (const auto& server : servers_) addresses.push_back(server.address);
    return addresses;
}

void Naming::set_there(const std::string& address, bool there) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto& server : servers_)
        if (server.address == address) server.there = there;
}

std::vector<std::string> Naming::bind(const std::string& path, CORBA::Object_ptr object) {
    std::vector<Server> servers;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        std::erase_if(entries_, [&](const Entry& entry) { return entry.path == path; });
        entries_.push_back({path, CORBA::Object::_duplicate(object)});
        servers = servers_;
    }
    std::vector<std::string> refusals;
    for (const auto& server : servers) {
        if (!server.there) continue; // was said when it went
        try {
            CosNaming::NamingContext_var root = name_server(orb_.in(), server.address);
            bind_in(root.in(), path, object);
        } catch (const NotThere& e) {
            set_there(server.address, false);
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

void Naming::unbind(const std::string& path) {
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
        if (!server.there) continue;
        try {
            CosNaming::NamingContext_var root = name_server(orb_.in(), server.address);
            if (look_up(root.in(), path, object.in()) == Found::ours) root->unbind(to_name(path));
        } catch (const NotThere&) {
            set_there(server.address, false); // its entries are gone with it, or stale
        } catch (const CORBA::Exception&) {
            continue; // somebody else has removed the entry just now
        }
    }
}

std::vector<std::string> Naming::update(bool rebind) {
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
        } catch (const NotThere& e) {
            if (server.there) line = std::string(e.what()) + "; names are bound again when it is back";
            set_there(server.address, false);
        } catch (const CORBA::Exception& e) {
            line = "name server " + server.address + " does not take our names (" + e._name() + ")";
        }
        if (!line.empty()) news.push_back(line);
    }
    return news;
}

std::string Naming::update(const Server& server, bool rebind) {
    const auto all = entries();
    CosNaming::NamingContext_var root = name_server(orb_.in(), server.address);
    std::vector<Entry> absent;
    bool forgotten = false;
    for (const auto& entry : all) {
        const Found found = look_up(root.in(), entry.path, entry.object.in());
        // What another process has taken since is left to it, as long as the server was there.
        if (found != Found::ours && !(found == Found::other && server.there)) absent.push_back(entry);
        forgotten = forgotten || found == Found::nothing_at_all;
    }
    set_there(server.address, true);
    if (absent.empty() || (server.there && !forgotten && !rebind)) return "";
    for (const auto& entry : absent) bind_in(root.in(), entry.path, entry.object.in());
    return "name server " + server.address + ": bound " + std::to_string(absent.size()) + " name" +
           (absent.size() == 1 ? "" : "s") + " again";
}

} // namespace RTC
