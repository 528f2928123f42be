// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/running/local_managers.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <unistd.h>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Inode of the socket -> IPv4 address and port, of all listening TCP sockets. A socket that listens on every
// interface is reached by the loopback address. The format is that of proc_pid_net(5).
std::map<std::string, std::string> listening_sockets() {
    std::map<std::string, std::string> sockets;
    std::ifstream table("/proc/net/tcp");
    std::string line;
    std::getline(table, line); // headings
    while (std::getline(table, line)) {
        std::istringstream words(line);
        std::string slot, local, remote, state, word, inode;
        // sl local_address rem_address st, then tx_queue:rx_queue tr:tm->when retrnsmt uid timeout, then inode
        words >> slot >> local >> remote >> state;
        for (int i = 0; i < 5; ++i) words >> word;
        words >> inode;
        if (state != "0A" /* TCP_LISTEN */ || local.size() < 13) continue;
        const std::string port = std::to_string(std::stoul(local.substr(9), nullptr, 16));
        unsigned char ip[4]; // written as one number of this machine's byte order
        for (int i = 0; i < 4; ++i)
            ip[3 - i] = static_cast<unsigned char>(
                std::stoul(local.substr(static_cast<std::size_t>(i) * 2, 2), nullptr, 16));
        std::string address = "127.0.0.1";
        if (local.compare(0, 8, "00000000") != 0) {
            address.clear();
            for (int i = 0; i < 4; ++i) address += (i == 0 ? "" : ".") + std::to_string(ip[i]);
        }
        sockets.emplace(inode, address + ":" + port);
    }
    return sockets;
}

// Whether the process has mapped omniORB; false also for a process whose maps this user may not read.
bool has_omniorb(const fs::path& process) {
    std::ifstream maps(process / "maps");
    std::string line;
    while (std::getline(maps, line))
        if (line.find("libomniORB4.so") != std::string::npos) return true;
    return false;
}

// Inodes of the sockets that a process has open.
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

// Three filters, the cheap ones first: processes with an ORB, the ports on which these listen, and whether a manager
// answers there.
std::vector<std::string> find_local_managers(CORBA::ORB_ptr orb) {
    const auto sockets = listening_sockets();
    std::set<std::string> candidates;
    std::error_code none;
    for (fs::directory_iterator it("/proc", none), end; !none && it != end; it.increment(none)) {
        const std::string name = it->path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos || name == std::to_string(getpid()))
            continue;
        // Without this, every server of the user would be sent a CORBA message that it does not understand.
        if (!has_omniorb(it->path())) continue;
        for (const auto& inode : sockets_of(it->path())) {
            // A process's other sockets are connections or of another family.
            const auto found = sockets.find(inode);
            if (found != sockets.end()) candidates.insert(found->second);
        }
    }
    std::vector<std::string> managers;
    for (const auto& address : candidates) { // half a second each: they are on this machine
        try {
            RTM::Manager_var manager = RTC::resolve_manager(orb, address, 500);
            managers.push_back(address);
        } catch (const RTC::RemoteUnavailable&) {
            continue; // another CORBA server, for instance a name server
        }
    }
    return managers;
}

} // namespace tandem::command
