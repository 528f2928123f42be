// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/host_files/inventory_reader.hpp"

#include "apps/tandem/monitor/host_files/process_files.hpp"
#include "host/process/published/inventory.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <set>
#include <tuple>

namespace tandem::monitor {
namespace {

using Head = process::InventoryHead;
using Fields = std::vector<std::string>;

/// A connection that has a line in the inventory, by its two ends.
struct Connection {
    std::string from_component, from_port, to_component, to_port;
};

Fields split(const std::string& text, char at) {
    Fields fields;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(at, begin)) != std::string::npos; begin = end + 1)
        fields.push_back(text.substr(begin, end - begin));
    fields.push_back(text.substr(begin));
    return fields;
}

std::uint64_t number(const std::string& text) {
    std::uint64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// Returns what distinguishes a file from others, including one of the process before with the same pid.
std::uint64_t inode_of(const process::FileDescriptor& file) {
    struct stat info {};
    return fstat(file.get(), &info) == 0 ? info.st_ino : 0;
}

Fields rest(const Fields& fields, std::size_t from) {
    return {fields.begin() + static_cast<std::ptrdiff_t>(from), fields.end()};
}

/// Returns false if the line does not describe a part.
bool add_part(const Fields& fields, HostInventory& inventory, std::vector<Connection>& connections) {
    const std::string& kind = fields[0];
    if (kind == "component" && fields.size() >= 5)
        inventory.components.push_back({fields[1], fields[2], fields[3], number(fields[4]), rest(fields, 5)});
    else if (kind == "context" && fields.size() >= 5)
        inventory.contexts.push_back(
            {fields[1], fields[2], number(fields[3]), fields[4] == "1", rest(fields, 5)});
    else if (kind == "port" && fields.size() >= 6)
        inventory.ports.push_back({fields[1], fields[2], fields[3], fields[4], fields[5], rest(fields, 6)});
    else if (kind == "connection" && fields.size() == 5)
        connections.push_back({fields[1], fields[2], fields[3], fields[4]});
    else
        return false;
    return true;
}

/// Gives the two ports of each connection an id in common. The ports are sorted.
void add_connection_ids(const std::vector<Connection>& connections, HostInventory& inventory) {
    const auto add = [&](const std::string& component, const std::string& port, const std::string& id) {
        const auto found = std::lower_bound(
            inventory.ports.begin(), inventory.ports.end(), std::tie(component, port),
            [](const HostPort& a, const auto& wanted) { return std::tie(a.component, a.name) < wanted; });
        if (found != inventory.ports.end() && found->component == component && found->name == port)
            found->connections.push_back(id);
    };
    for (const auto& [from, out, to, in] : connections) {
        const std::string id = from + "." + out + " -> " + to + "." + in;
        add(from, out, id);
        add(to, in, id);
    }
}

} // namespace

void parse_inventory(const std::string& text, HostInventory& inventory) {
    std::vector<Connection> connections;
    for (const std::string& raw : split(text, '\n')) {
        const std::string line = raw.substr(0, raw.find_last_not_of(' ') + 1);
        if (line.empty()) continue;
        Fields fields = split(line, '\t');
        for (std::string& field : fields) field = command::replace_nonprintable(field);
        if (!add_part(fields, inventory, connections)) ++inventory.left_out;
    }
    const auto sort = [](auto& parts, auto name_of) {
        std::stable_sort(parts.begin(), parts.end(),
                         [&](const auto& a, const auto& b) { return name_of(a) < name_of(b); });
    };
    sort(inventory.components, [](const HostComponent& part) { return std::tie(part.name); });
    sort(inventory.contexts, [](const HostContext& part) { return std::tie(part.owner); });
    sort(inventory.ports, [](const HostPort& part) { return std::tie(part.component, part.name); });
    add_connection_ids(connections, inventory);
}

/// Returns whether the text has changed.
bool InventoryReader::read_file(File& file) {
    const auto read_head = [&](Head& head) {
        return pread(file.file.get(), &head, sizeof head, 0) == static_cast<ssize_t>(sizeof head) &&
               std::memcmp(head.magic, Head::magic_text, sizeof head.magic) == 0 && head.sequence % 2 == 0 &&
               head.text_bytes <= Head::max_text_bytes;
    };
    Head before{}, after{};
    if (!read_head(before) || before.sequence == file.sequence) return false;
    std::string text(before.text_bytes, '\0');
    if (pread(file.file.get(), text.data(), text.size(), sizeof before) !=
            static_cast<ssize_t>(text.size()) ||
        !read_head(after) || after.sequence != before.sequence)
        return false;
    file.sequence = before.sequence;
    file.text = std::move(text);
    file.left_out = before.left_out;
    return true;
}

bool InventoryReader::look(std::uint32_t pid) {
    auto files = open_memory_files(pid, Head::file_name, Head::file_bytes);
    if (files.empty()) {
        processes_.erase(pid); // the process that had the number before
        return false;
    }
    Process& process = processes_[pid];
    const bool same = std::equal(
        files.begin(), files.end(), process.files.begin(), process.files.end(),
        [](const auto& found, const File& known) { return inode_of(found) == inode_of(known.file); });
    if (same) return true; // the read texts stay
    process = {};
    for (auto& file : files) process.files.push_back({std::move(file)});
    return true;
}

std::shared_ptr<const HostInventory> InventoryReader::read(std::uint32_t pid) {
    const auto process = processes_.find(pid);
    if (process == processes_.end()) return nullptr;
    bool changed = process->second.inventory == nullptr;
    for (File& file : process->second.files) changed |= read_file(file);
    if (!changed) return process->second.inventory;
    auto inventory = std::make_shared<HostInventory>();
    std::string all;
    for (const File& file : process->second.files) {
        all += file.text + "\n";
        inventory->left_out += file.left_out;
    }
    parse_inventory(all, *inventory);
    return process->second.inventory = std::move(inventory);
}

void InventoryReader::keep(const std::vector<std::uint32_t>& pids) {
    const std::set<std::uint32_t> kept(pids.begin(), pids.end());
    std::erase_if(processes_, [&](const auto& process) { return kept.count(process.first) == 0; });
}

} // namespace tandem::monitor
