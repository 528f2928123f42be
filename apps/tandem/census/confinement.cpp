// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/census/confinement.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kill_timeout = 5s;

void limit(int resource, rlim_t bytes) {
    rlimit values{};
    getrlimit(static_cast<__rlimit_resource>(resource), &values);
    values.rlim_cur = std::min(bytes, values.rlim_max);
    setrlimit(static_cast<__rlimit_resource>(resource), &values);
}

// Returns the parent of a process; 0 if the process is gone.
pid_t parent_of(const fs::path& process) {
    std::ifstream status(process / "status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("PPid:")) return std::atoi(line.c_str() + 5);
    return 0;
}

std::vector<pid_t> children() {
    std::vector<pid_t> found;
    std::error_code ignored;
    for (fs::directory_iterator at("/proc", ignored), end; !ignored && at != end; at.increment(ignored)) {
        const pid_t pid = std::atoi(at->path().filename().c_str());
        if (pid > 0 && parent_of(at->path()) == getpid()) found.push_back(pid);
    }
    return found;
}

// The children of a killed process become children of this one, so there may be several rounds. The wait is bounded: a
// program with the rights of another user is not killed, and one inside the kernel may take long.
void kill_children() {
    const auto deadline = std::chrono::steady_clock::now() + kill_timeout;
    while (std::chrono::steady_clock::now() < deadline) {
        const auto left = children();
        if (left.empty()) return;
        for (const pid_t pid : left) kill(pid, SIGKILL);
        for (const pid_t pid : left) waitpid(pid, nullptr, WNOHANG);
        std::this_thread::sleep_for(1ms);
    }
}

} // namespace

Confinement::Confinement() {
    std::string name = (fs::temp_directory_path() / "tandem-census-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("temporary folder " + name + " cannot be created");
    folder_ = name;
    setenv("TMPDIR", name.c_str(), 1);
    setenv("XDG_RUNTIME_DIR", name.c_str(), 1);
    // Without a display, Qt would abort a component that opens a window, for example by OpenCV.
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) setenv("QT_QPA_PLATFORM", "offscreen", 0);
    if (!std::freopen("/dev/null", "r", stdin)) throw std::runtime_error("/dev/null cannot be opened");
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, rlim_t{256} << 20);
    // The shadow memory of sanitizers is larger.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    limit(RLIMIT_AS, rlim_t{4} << 30);
#endif
}

Confinement::~Confinement() {
    kill_children();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void Confinement::clean() {
    kill_children();
    std::error_code ignored;
    std::vector<fs::path> left;
    for (fs::directory_iterator at(folder_, ignored), end; !ignored && at != end; at.increment(ignored))
        left.push_back(at->path());
    for (const auto& path : left) fs::remove_all(path, ignored);
}

} // namespace tandem::command
