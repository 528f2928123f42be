// SPDX-License-Identifier: Apache-2.0
// The folder keeps other users out, because connect() needs search permission for it. A reference to a process on
// another machine of the same host name must not lead to a process on this machine. The random part of a socket's name
// prevents this.
#include "host/local/local_endpoint.hpp"
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace tandem::local {
namespace {

namespace fs = std::filesystem;

constexpr const char* shared_memory = "/dev/shm";

bool belongs_to_this_user_alone(const fs::path& folder) {
    struct stat status {};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & 077) == 0;
}

// omniORB's references and corbaloc addresses, which contain the path of a manager's socket, end it at these characters.
bool is_usable_in_references(const fs::path& folder) {
    constexpr std::size_t longest_name = 40; // KIND.PID.RANDOM
    return folder.is_absolute() && folder.native().find_first_of(":,#%") == std::string::npos &&
           folder.native().size() + longest_name < sizeof(sockaddr_un{}.sun_path);
}

// XDG Base Directory Specification: the folder belongs to the user and has mode 0700. A folder of another user, as
// after `su`, is not used.
std::vector<fs::path> runtime_folders() {
    std::vector<fs::path> folders;
    const char* const named = std::getenv("XDG_RUNTIME_DIR");
    for (const fs::path& folder :
         {fs::path(named == nullptr ? "" : named), "/run/user" / fs::path(std::to_string(::geteuid()))})
        if (is_usable_in_references(folder) && belongs_to_this_user_alone(folder) &&
            std::find(folders.begin(), folders.end(), folder / "tandem") == folders.end())
            folders.push_back(folder / "tandem");
    return folders;
}

std::string shared_memory_prefix() { return "tandem-" + std::to_string(::geteuid()) + "-"; }

// Other users may create folders of any name there. Their folders are skipped.
std::vector<fs::path> folders_in_shared_memory() {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator it(shared_memory, error), end; !error && it != end; it.increment(error))
        if (it->path().filename().native().starts_with(shared_memory_prefix()) &&
            belongs_to_this_user_alone(it->path()))
            folders.push_back(it->path());
    std::sort(folders.begin(), folders.end());
    return folders;
}

fs::path make_folder() {
    for (const auto& folder : runtime_folders())
        if ((::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST) && belongs_to_this_user_alone(folder))
            return folder;
    if (const auto folders = folders_in_shared_memory(); !folders.empty()) return folders.front();
    std::string folder = shared_memory + ("/" + shared_memory_prefix()) + "XXXXXX";
    if (::mkdtemp(folder.data()) == nullptr)
        throw std::runtime_error(
            std::string("no folder for the socket of this process in XDG_RUNTIME_DIR or ") + shared_memory +
            ": " + std::strerror(errno) + "; set XDG_RUNTIME_DIR to a folder of yours with mode 0700");
    return folder;
}

// KIND.PID.RANDOM
bool read_pid(const std::string& name, const std::string& kind, pid_t& pid) {
    if (!name.starts_with(kind + ".")) return false;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + kind.size() + 1, end, pid);
    return error == std::errc() && rest != end && *rest == '.' && pid > 0;
}

void add_endpoints(const fs::path& folder, const std::string& kind, std::vector<LocalEndpoint>& endpoints) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        pid_t pid = 0;
        if (read_pid(it->path().filename().native(), kind, pid)) endpoints.push_back({pid, it->path()});
    }
}

void remove_ended(const std::vector<LocalEndpoint>& endpoints) {
    // Requires both: a process that is starting does not accept connections yet, and a process id may be known only in
    // another process namespace.
    for (const auto& endpoint : endpoints)
        if (::kill(endpoint.pid, 0) != 0 && errno == ESRCH && !accepts_connections(endpoint.socket))
            ::unlink(endpoint.socket.c_str());
}

std::string random_hex() {
    std::uint64_t bits = 0;
    if (::getrandom(&bits, sizeof bits, 0) != sizeof bits)
        throw std::runtime_error(std::string("no random numbers: ") + std::strerror(errno));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
    return text;
}

} // namespace

fs::path make_local_endpoint(const std::string& kind) {
    const fs::path folder = make_folder();
    std::vector<LocalEndpoint> earlier;
    add_endpoints(folder, kind, earlier);
    remove_ended(earlier);
    return folder / (kind + "." + std::to_string(::getpid()) + "." + random_hex());
}

std::vector<LocalEndpoint> find_local_endpoints(const std::string& kind) {
    std::vector<LocalEndpoint> endpoints;
    for (const auto& folder : runtime_folders())
        if (belongs_to_this_user_alone(folder)) add_endpoints(folder, kind, endpoints);
    for (const auto& folder : folders_in_shared_memory()) add_endpoints(folder, kind, endpoints);
    std::sort(endpoints.begin(), endpoints.end(), [](auto& a, auto& b) { return a.socket < b.socket; });
    return endpoints;
}

void remove_ended_endpoints(const std::string& kind) { remove_ended(find_local_endpoints(kind)); }

void remove_local_endpoint(const std::string& kind) {
    for (const auto& endpoint : find_local_endpoints(kind))
        if (endpoint.pid == ::getpid()) ::unlink(endpoint.socket.c_str());
}

bool accepts_connections(const fs::path& socket) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (socket.native().size() >= sizeof address.sun_path) return false;
    socket.native().copy(address.sun_path, sizeof address.sun_path); // a 0 follows
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0) return true; // nothing is known, so assume yes
    const int error = ::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 ? 0 : errno;
    ::close(fd);
    return error == 0 || error == EAGAIN; // EAGAIN: its connection queue is full
}

} // namespace tandem::local
