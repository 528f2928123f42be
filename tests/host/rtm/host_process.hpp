// SPDX-License-Identifier: Apache-2.0
// rtm_host as a child process of a test. Every wait has a time limit.
#pragma once
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace testing {

/// A TCP port that nobody listens on now. Another process may take it before the test does.
inline std::string unused_port() {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(fd, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
    close(fd);
    return std::to_string(ntohs(address.sin_port));
}

/// Returns whether a process listens at this TCP port of 127.0.0.1.
inline bool is_listening(const std::string& port) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
    const bool connected = connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    close(fd);
    return connected;
}

/// Starts rtm_host with these arguments, reads what it prints, kills it at the end.
class HostProcess {
  public:
    explicit HostProcess(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), TANDEM_RTM_HOST);
        int out[2], err[2];
        if (pipe(out) != 0 || pipe(err) != 0) throw std::runtime_error("no pipe");
        pid_ = fork();
        if (pid_ == 0) {
            dup2(out[1], 1);
            dup2(err[1], 2);
            for (int fd : {out[0], out[1], err[0], err[1]}) close(fd);
            std::vector<char*> argv;
            for (auto& argument : arguments) argv.push_back(argument.data());
            argv.push_back(nullptr);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(out[1]);
        close(err[1]);
        out_ = out[0];
        err_ = err[0];
    }
    ~HostProcess() {
        if (!ended_) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
        close(out_);
        close(err_);
    }

    /// Waits until `text` appears on standard output. Returns false after `timeout`, or if the process ends without it.
    bool wait_for_output(const std::string& text,
                         std::chrono::milliseconds timeout = std::chrono::seconds(30)) {
        return wait_for_text(output, text, timeout);
    }
    /// Waits up to 30 s until `text` appears on standard error.
    bool wait_for_error(const std::string& text) {
        return wait_for_text(errors, text, std::chrono::seconds(30));
    }
    /// Stops (or resumes) reading standard error, so that the process may fill the pipe.
    void stall_errors(bool stalled) { err_open_ = !stalled; }
    void send_signal(int signal) { kill(pid_, signal); }
    /// Sends SIGSTOP and waits until all threads have stopped: it answers no call then. SIGCONT continues it.
    bool suspend() {
        kill(pid_, SIGSTOP);
        for (int i = 0; i < 10000; ++i) {
            int status = 0;
            if (waitpid(pid_, &status, WUNTRACED | WNOHANG) == pid_) return WIFSTOPPED(status);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }
    pid_t pid() const { return pid_; }
    std::size_t descriptor_count() const {
        const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid_) + "/fd");
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
    std::size_t thread_count() const {
        const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid_) + "/task");
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }
    /// Waits until no thread of the process runs or waits for a processor, so that it has finished its work.
    bool wait_until_idle() const {
        for (int i = 0; i < 10000; ++i) {
            bool busy = false;
            for (const auto& task :
                 std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
                std::ifstream stat(task.path() / "stat");
                std::string line;
                std::getline(stat, line);
                busy = busy || line.substr(std::min(line.size(), line.rfind(')'))).starts_with(") R");
            }
            if (!busy) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }
    /// CPU time so far of all threads, including those that have ended, in ticks of sysconf(_SC_CLK_TCK): 10 ms.
    long cpu_ticks() const {
        std::ifstream stat("/proc/" + std::to_string(pid_) + "/stat");
        std::string line;
        std::getline(stat, line);
        std::istringstream words(line.substr(line.rfind(')') + 1)); // the name may contain spaces
        std::string word;
        for (int i = 3; i < 14; ++i) words >> word; // [proc(5): fields 14 and 15]
        long user = 0, system = 0;
        words >> user >> system;
        return user + system;
    }
    /// Resident memory in MB, now or (`peak`) at most so far.
    long memory_mb(bool peak = false) const {
        std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
        for (std::string line; std::getline(status, line);)
            if (line.compare(0, 6, peak ? "VmHWM:" : "VmRSS:") == 0) return std::stol(line.substr(6)) / 1024;
        return -1;
    }
    /// The exit code, or minus the number of the signal that has ended it; -1000 when it still runs.
    int wait_for_exit(std::chrono::seconds timeout = std::chrono::seconds(30)) {
        const auto end = std::chrono::steady_clock::now() + timeout;
        int status = 0;
        while (waitpid(pid_, &status, WNOHANG) == 0) {
            if (std::chrono::steady_clock::now() > end) return -1000;
            read_some();
        }
        ended_ = true;
        while (read_some()) continue;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    std::string output, errors; ///< all that it has written on standard output and standard error

  private:
    bool wait_for_text(const std::string& where, const std::string& text, std::chrono::milliseconds timeout) {
        const auto end = std::chrono::steady_clock::now() + timeout;
        while (where.find(text) == std::string::npos)
            if (std::chrono::steady_clock::now() > end || !read_some())
                return where.find(text) != std::string::npos;
        return true;
    }
    // Reads what arrives on either pipe within 50 ms. Returns false if both are closed.
    bool read_some() {
        pollfd fds[2] = {{out_open_ ? out_ : -1, POLLIN, 0}, {err_open_ ? err_ : -1, POLLIN, 0}};
        if (!out_open_ && !err_open_) return false;
        if (poll(fds, 2, 50) <= 0) return true;
        take(fds[0], output, out_open_);
        take(fds[1], errors, err_open_);
        return true;
    }
    static void take(const pollfd& fd, std::string& to, bool& open) {
        if (fd.revents == 0) return;
        char buffer[4096];
        const ssize_t n = read(fd.fd, buffer, sizeof buffer);
        if (n > 0)
            to.append(buffer, static_cast<std::size_t>(n));
        else
            open = false;
    }

    pid_t pid_ = -1;
    int out_ = -1, err_ = -1;
    bool out_open_ = true, err_open_ = true;
    bool ended_ = false;
};

} // namespace testing
