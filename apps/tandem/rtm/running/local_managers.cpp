// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/local_managers.hpp"
#include "host/local/local_endpoint.hpp"
#include "host/process/listening_sockets.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <unistd.h>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Returns the address to reach a listening socket from this machine; empty for IPv6 addresses other than loopback. Uses
// 127.0.0.1 for a socket that listens at every address, because omniORB's IPv6 sockets also accept IPv4. Each group of
// eight digits is a number in this machine's byte order (little-endian, as for all of Tandem).
std::string address_to_connect_to(std::string digits) {
    if (digits.find_first_not_of('0') == std::string::npos) return "127.0.0.1";
    if (digits == "00000000000000000000000001000000") return "[::1]";
    if (digits.compare(0, 24, "0000000000000000FFFF0000") == 0) digits.erase(0, 24); // IPv4 in an IPv6 socket
    if (digits.size() != 8) return "";
    std::string address;
    for (int i = 3; i >= 0; --i)
        address +=
            std::to_string(std::stoul(digits.substr(static_cast<std::size_t>(i) * 2, 2), nullptr, 16)) +
            (i > 0 ? "." : "");
    return address;
}

// Maps the inode of each listening TCP socket to its address and port.
void add_listening_sockets(const char* path, std::map<std::string, std::string>& sockets) {
    std::ifstream table(path);
    for (const auto& [local, inode] : process::read_listening_sockets(table)) {
        const std::size_t colon = local.find(':');
        if (colon == std::string::npos) continue;
        const std::string address = address_to_connect_to(local.substr(0, colon));
        if (!address.empty())
            sockets.emplace(inode,
                            address + ":" + std::to_string(std::stoul(local.substr(colon + 1), nullptr, 16)));
    }
}

std::map<std::string, std::string> listening_sockets() {
    std::map<std::string, std::string> sockets;
    add_listening_sockets("/proc/net/tcp", sockets);
    add_listening_sockets("/proc/net/tcp6", sockets); // absent without IPv6
    return sockets;
}

// Returns whether the process has mapped omniORB; false if this user may not read its maps.
bool has_omniorb(const fs::path& process) {
    std::ifstream maps(process / "maps");
    std::string line;
    while (std::getline(maps, line))
        if (line.find("libomniORB4.so") != std::string::npos) return true;
    return false;
}

// Returns the inodes of a process's open sockets.
std::set<std::string> sockets_of(const fs::path& process) {
    std::set<std::string> inodes;
    std::error_code none;
    for (fs::directory_iterator it(process / "fd", none), end; !none && it != end; it.increment(none)) {
        std::error_code gone;
        const std::string target = fs::read_symlink(it->path(), gone).string();
        if (!gone && target.compare(0, 8, "socket:[") == 0)
            inodes.insert(target.substr(8, target.size() - 9));
    }
    return inodes;
}

} // namespace

// Managers of Tandem have a socket for discovery. For those of OpenRTM-aist, three filters are used, the cheapest
// first: processes with an ORB, their listening ports, and whether a manager answers there.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb, pid_t pid) {
    std::set<std::string> candidates;
    std::set<pid_t> found_by_socket{getpid()};
    for (const auto& endpoint : local::find_local_endpoints(local::manager_endpoint)) {
        if (!found_by_socket.insert(endpoint.pid).second || (pid != 0 && endpoint.pid != pid)) continue;
        candidates.insert(RTC::local_manager_address(endpoint.pid));
    }
    const auto sockets = listening_sockets();
    std::error_code none;
    for (fs::directory_iterator it("/proc", none), end; !none && it != end; it.increment(none)) {
        const std::string name = it->path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (pid != 0 && name != std::to_string(pid)) continue;
        if (found_by_socket.count(static_cast<pid_t>(std::stol(name))) != 0) continue;
        // Without this check, every server of the user would receive a CORBA message that it does not understand.
        if (!has_omniorb(it->path())) continue;
        for (const auto& inode : sockets_of(it->path())) {
            // Other sockets of a process are connections, or unreachable from here.
            const auto found = sockets.find(inode);
            if (found != sockets.end()) candidates.insert(found->second);
        }
    }
    std::vector<std::string> managers;
    for (const auto& address : candidates) { // half a second each, because they are on this machine
        try {
            RTM::Manager_var manager = RTC::resolve_manager(orb, address, 500);
            managers.push_back(address);
        } catch (const RTC::RemoteUnavailable&) {
            continue; // another CORBA server, for example a name server
        }
    }
    return managers;
}

} // namespace tandem::command
