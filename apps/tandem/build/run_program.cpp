// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/run_program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <poll.h>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h> // of glibc 2.36, which forgets to say that it is C
}

namespace tandem::command {
namespace {

/// A file without a name, for all that the program says.
std::unique_ptr<FILE, int (*)(FILE*)> scratch() {
    std::unique_ptr<FILE, int (*)(FILE*)> file(std::tmpfile(), std::fclose);
    if (!file) throw std::runtime_error(std::string("no temporary file: ") + std::strerror(errno));
    return file;
}

std::string content(FILE* file) {
    std::string text;
    std::array<char, 4096> chunk;
    std::rewind(file);
    while (const auto got = std::fread(chunk.data(), 1, chunk.size(), file)) text.append(chunk.data(), got);
    return text;
}

class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {
        if (number_ < 0) throw std::runtime_error(std::string("no descriptor: ") + std::strerror(errno));
    }
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    operator int() const { return number_; }

  private:
    int number_;
};

/// The signals that end a command, held back for the time of its life.
class HeldSignals {
  public:
    HeldSignals() {
        sigemptyset(&set_);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set_, signal);
        pthread_sigmask(SIG_BLOCK, &set_, &before_);
    }
    ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;
    const sigset_t& set() const { return set_; }

  private:
    sigset_t set_, before_;
};

/// A program and all that it starts, in a group of its own; killed at the end of the scope if need be.
class Group {
  public:
    Group(const std::vector<std::string>& command, int output) {
        std::vector<char*> argv;
        for (const auto& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        for (const int target : {STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_adddup2(&actions, output, target);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
        const int error = posix_spawnp(&pid_, argv[0], &actions, &attributes, argv.data(), environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0)
            throw std::runtime_error(command[0] + " cannot be started: " + std::strerror(error) +
                                     "; install it (apt install " + command[0] + ")");
    }
    ~Group() {
        kill(-pid_, SIGKILL);
        if (!reaped_) wait();
        // Its children have another parent by now; they are gone when the group is.
        for (int i = 0; i < 1000 && kill(-pid_, 0) == 0; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

    pid_t pid() const { return pid_; }
    int wait() {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
        reaped_ = true;
        return status;
    }

  private:
    pid_t pid_ = -1;
    bool reaped_ = false;
};

/// Whether it has ended in time. Throws when a signal came instead.
bool ends_within(const Group& group, const HeldSignals& signals, std::chrono::milliseconds bound) {
    const Descriptor end(pidfd_open(group.pid(), 0)), signal(signalfd(-1, &signals.set(), SFD_CLOEXEC));
    const auto deadline = std::chrono::steady_clock::now() + bound;
    for (;;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        std::array<pollfd, 2> fds{{{end, POLLIN, 0}, {signal, POLLIN, 0}}};
        const int ready = left.count() > 0 ? poll(fds.data(), fds.size(), static_cast<int>(left.count())) : 0;
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return false;
        if (fds[0].revents) return true;
        signalfd_siginfo info;
        if (read(signal, &info, sizeof info) == sizeof info)
            throw std::runtime_error(std::string("ended by a signal: ") +
                                     strsignal(static_cast<int>(info.ssi_signo)));
    }
}

} // namespace

ProgramEnd run_program(const std::vector<std::string>& command, std::chrono::milliseconds bound) {
    const auto output = scratch();
    const HeldSignals signals;
    Group group(command, fileno(output.get()));
    if (!ends_within(group, signals, bound)) return {true, -1, content(output.get())};
    const int status = group.wait();
    return {false, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content(output.get())};
}

namespace {

// CMake's own errors: a line with the place, then the text, indented and broken into lines, then an empty
// one.
std::string cmake_error(std::string text, std::istream& lines) {
    for (std::string line; std::getline(lines, line) && line.rfind("  ", 0) == 0;)
        text += line.substr(1); // one of the two spaces is between the words
    return text;
}

} // namespace

std::string first_error(const std::string& output) {
    std::istringstream lines(output);
    std::string line, last;
    while (std::getline(lines, line)) {
        if (line.find("CMake Error at ") != std::string::npos) return cmake_error(line, lines);
        for (const char* word :
             {"error: ", "undefined reference", "multiple definition", "CMake Error", "undefined symbol",
              // omniidl's
              ": Syntax error", ": Error in ", ": No such file or directory"})
            if (line.find(word) != std::string::npos) return line;
        if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    }
    return last;
}

} // namespace tandem::command
