// SPDX-License-Identifier: Apache-2.0
// OpenRTM-aist: NamingOnCorba, and NamingManager::update() with naming.update.enable and naming.update.rebind.
#include "host/rtm/runtime/naming/name_bindings.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <algorithm>

namespace RTC {
namespace {

// Creates all contexts of a path; those that exist are kept.
void create_contexts(CosNaming::NamingContext_ptr root, const CosNaming::Name& name) {
    for (CORBA::ULong depth = 1; depth < name.length(); ++depth) {
        CosNaming::Name prefix(name);
        prefix.length(depth);
        try {
            CosNaming::NamingContext_var created = root->bind_new_context(prefix);
        } catch (const CosNaming::NamingContext::AlreadyBound&) {
            continue;
        }
    }
}

void bind_path(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    const CosNaming::Name name = to_corba_name(path);
    create_contexts(root, name);
    root->rebind(name, object); // an earlier run of this host may have left an entry
}

// The state of one of our names in a server.
enum class Binding { ours, foreign, missing, context_missing };

Binding query_binding(CosNaming::NamingContext_ptr root, const std::string& path, CORBA::Object_ptr object) {
    const CosNaming::Name name = to_corba_name(path);
    try {
        CORBA::Object_var present = root->resolve(name);
        return present->_is_equivalent(object) ? Binding::ours : Binding::foreign;
    } catch (const CosNaming::NamingContext::NotFound& e) {
        // Nobody unbinds contexts. So a server without even the first context of the path was restarted and has lost
        // all entries.
        const bool first_part_missing = e.rest_of_name.length() == name.length();
        return first_part_missing && name.length() > 1 ? Binding::context_missing : Binding::missing;
    }
}

} // namespace

NameBindings::NameBindings(CORBA::ORB_ptr orb, const std::vector<std::string>& servers)
    : orb_(CORBA::ORB::_duplicate(orb)) {
    for (const auto& server : servers) servers_.push_back({with_default_port(server, 2809), true});
}

void NameBindings::add_server(const std::string& server) {
    const std::string address = with_default_port(server, 2809);
    {
        std::lock_guard<std::mutex> lock(mutex_);
        for (const auto& present : servers_)
            if (present.address == address) return;
        servers_.push_back({address, true});
        if (servers_.size() > 1) return;
    }
    if (on_first_server_) on_first_server_();
}

std::vector<NameBindings::Entry> NameBindings::entries() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return entries_;
}

std::vector<NameBindings::Server> NameBindings::server_states() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return servers_;
}

std::vector<std::string> NameBindings::servers() const {
    std::vector<std::string> addresses;
    for (const auto& server : server_states()) addresses.push_back(server.address);
    return addresses;
}

std::vector<std::string> NameBindings::reachable_servers() const {
    std::vector<std::string> addresses;
    for (const auto& server : server_states())
        if (server.reachable) addresses.push_back(server.address);
    return addresses;
}

void NameBindings::set_reachable(const std::string& address, bool reachable) {
    std::lock_guard<std::mutex> lock(mutex_);
    for (auto& server : servers_)
        if (server.address == address) server.reachable = reachable;
}

// The entry is recorded first: a server that fails now gets it by update().
std::vector<std::string> NameBindings::bind(const std::string& path, CORBA::Object_ptr object) {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        std::erase_if(entries_, [&](const Entry& entry) { return entry.path == path; });
        entries_.push_back({path, CORBA::Object::_duplicate(object)});
    }
    std::vector<std::string> errors;
    for (const auto& server : server_states()) {
        if (!server.reachable) continue; // reported when it became unreachable
        try {
            CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
            bind_path(root.in(), path, object);
        } catch (const RemoteUnavailable& e) {
            set_reachable(server.address, false);
            errors.push_back(std::string(e.what()) +
                             "; names are bound when it is available; start omniNames "
                             "there or set naming.enable: NO");
        } catch (const CORBA::Exception& e) {
            errors.push_back("name server " + server.address + " refuses the name " + path + ": " +
                             describe_exception(e));
        }
    }
    return errors;
}

void NameBindings::unbind(const std::string& path) {
    CORBA::Object_var object;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        for (const auto& entry : entries_)
            if (entry.path == path) object = entry.object;
        std::erase_if(entries_, [&](const Entry& entry) { return entry.path == path; });
    }
    if (CORBA::is_nil(object.in())) return;
    for (const auto& server : server_states()) {
        if (!server.reachable) continue;
        try {
            CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
            // Another process may have taken the name since. Its entry stays.
            if (query_binding(root.in(), path, object.in()) == Binding::ours)
                root->unbind(to_corba_name(path));
        } catch (const RemoteUnavailable&) {
            set_reachable(server.address, false); // nothing to remove until it is back
        } catch (const CORBA::Exception&) {
            continue; // another process has just removed the entry
        }
    }
}

std::vector<std::string> NameBindings::update(bool rebind) {
    std::vector<std::string> messages;
    for (const auto& server : server_states()) {
        std::string message;
        try {
            message = update(server, rebind);
        } catch (const RemoteUnavailable& e) {
            // Reported once, not at each update.
            if (server.reachable) message = std::string(e.what()) + "; names are bound again when it is back";
            set_reachable(server.address, false);
        } catch (const CORBA::Exception& e) {
            message = "name server " + server.address + " refuses our names: " + describe_exception(e);
        }
        if (!message.empty()) messages.push_back(message);
    }
    return messages;
}

// `server` is a copy from before the call: server.reachable is the result of the previous call.
std::string NameBindings::update(const Server& server, bool rebind) {
    CosNaming::NamingContext_var root = resolve_name_server(orb_.in(), server.address);
    std::vector<Entry> missing;
    bool lost_entries = false;
    for (const auto& entry : entries()) {
        const Binding binding = query_binding(root.in(), entry.path, entry.object.in());
        // If another process has taken a name while the server was reachable, the name is left to it. If the server was
        // not reachable, the foreign object may also come from an earlier run of this host.
        if (binding != Binding::ours && !(binding == Binding::foreign && server.reachable))
            missing.push_back(entry);
        lost_entries = lost_entries || binding == Binding::context_missing;
    }
    set_reachable(server.address, true);
    // If a single entry is missing, a tool has unbound it. It stays unbound unless `rebind` is set.
    if (missing.empty() || (server.reachable && !lost_entries && !rebind)) return "";
    for (const auto& entry : missing) bind_path(root.in(), entry.path, entry.object.in());
    return "name server " + server.address + ": bound " + std::to_string(missing.size()) + " name" +
           (missing.size() == 1 ? "" : "s") + " again";
}

} // namespace RTC
