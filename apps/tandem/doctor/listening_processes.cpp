// SPDX-License-Identifier: Apache-2.0
// Finds the listening TCP sockets of the user's processes in /proc, see proc_pid_net(5).
#include "apps/tandem/doctor/exposure.hpp"

#include "host/process/listening_sockets.hpp"

#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <sstream>
#include <sys/stat.h>

namespace tandem::doctor {
namespace {

namespace fs = std::filesystem;

/// Returns the number of hexadecimal digits; 0 for any other text.
std::uint32_t parse_hex(const std::string& digits) {
    std::uint32_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    return number;
}

/// Parses ADDRESS:PORT of /proc/net/tcp. Each group of eight digits is a number in this machine's byte order.
TcpEndpoint parse_local_address(const std::string& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    std::array<std::uint32_t, 4> words{};
    for (std::size_t i = 0; i < words.size() && (i + 1) * 8 <= colon; ++i)
        words[i] = parse_hex(text.substr(i * 8, 8));
    const bool is_v6 = colon == 32;
    char number[INET6_ADDRSTRLEN] = {};
    inet_ntop(is_v6 ? AF_INET6 : AF_INET, words.data(), number, sizeof number);
    const std::string address = number;
    const bool is_loopback = is_v6 ? address == "::1" || address.compare(0, 11, "::ffff:127.") == 0
                                   : address.compare(0, 4, "127.") == 0;
    const std::string port =
        std::to_string(parse_hex(colon < text.size() ? text.substr(colon + 1) : std::string()));
    return {(is_v6 ? "[" + address + "]" : address) + ":" + port, !is_loopback};
}

/// Adds the listening sockets of a table, by inode.
void add_table(const Machine& machine, const char* path, std::map<std::string, TcpEndpoint>& sockets) {
    std::istringstream table(machine.content(path).value_or(""));
    for (const auto& socket : process::read_listening_sockets(table))
        sockets.emplace(socket.inode, parse_local_address(socket.address));
}

} // namespace

std::map<pid_t, std::vector<TcpEndpoint>> listening_processes(const Machine& machine) {
    std::map<std::string, TcpEndpoint> sockets;
    add_table(machine, "/proc/net/tcp", sockets);
    add_table(machine, "/proc/net/tcp6", sockets);
    std::map<pid_t, std::vector<TcpEndpoint>> processes;
    std::error_code none;
    for (fs::directory_iterator it(machine.path("/proc"), none), end; !none && it != end;
         it.increment(none)) {
        const std::string name = it->path().filename().string();
        struct stat status {};
        pid_t pid = 0;
        if (std::from_chars(name.data(), name.data() + name.size(), pid).ec != std::errc() ||
            ::stat(it->path().c_str(), &status) != 0 || status.st_uid != machine.probed.user)
            continue;
        std::error_code gone;
        for (fs::directory_iterator fd(it->path() / "fd", gone), last; !gone && fd != last;
             fd.increment(gone)) {
            std::error_code closed;
            const std::string target = fs::read_symlink(fd->path(), closed).string();
            if (closed || target.compare(0, 8, "socket:[") != 0) continue;
            const auto found = sockets.find(target.substr(8, target.size() - 9));
            if (found != sockets.end()) processes[pid].push_back(found->second);
        }
    }
    return processes;
}

} // namespace tandem::doctor
