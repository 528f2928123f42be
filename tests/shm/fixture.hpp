// SPDX-License-Identifier: Apache-2.0
// Common parts of this room's tests: separate links, child processes, the content of /dev/shm, stress sizes.
#pragma once
#include "shm/segment.hpp"
#include "tests/support/stress.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/wait.h>
#include <thread>

#ifdef TANDEM_COVERAGE
extern "C" void __gcov_dump(); // of libgcov: writes what this process has counted
#endif

namespace tandem::shm::test {

using namespace std::chrono_literals;

/// A link name that no other test or process uses; whatever it leaves in /dev/shm is removed at the end.
struct Link {
    std::string name = "test-" + std::to_string(getpid()) + "-" + std::to_string(next()++);
    ~Link() {
        for (const auto& file : files()) std::filesystem::remove(file);
    }
    std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(shm_directory))
            if (entry.path().filename().string().rfind(file_prefix(name), 0) == 0)
                found.push_back(entry.path());
        return found;
    }
    static int& next() {
        static int number = 0;
        return number;
    }
};

inline JoinOptions small(std::size_t bytes = 512 * 1024) {
    JoinOptions options;
    options.arena_bytes = bytes;
    return options;
}

inline std::unique_ptr<Segment> join(const Link& link, Side side, const JoinOptions& options = small()) {
    return Segment::join(link.name, side, options);
}

/// Both sides of a link in this process.
struct Pair {
    explicit Pair(const JoinOptions& options = small())
        : first(join(link, Side::first, options)), second(join(link, Side::second, options)) {}
    Link link;
    std::unique_ptr<Segment> first, second;
};

/// A child process that runs a function and exits with its result. It is killed at the end of the scope if it still runs.
class Child {
  public:
    static constexpr int killed = -1, crashed = -2; ///< ends without an exit code
    explicit Child(const std::function<int()>& work) : pid_(fork()) {
        if (pid_ != 0) return;
        int code = 99;
        try {
            code = work();
        } catch (const std::exception& failure) {
            fprintf(stderr, "child: %s\n", failure.what());
        }
#ifdef TANDEM_COVERAGE
        __gcov_dump(); // _exit() does not
#endif
        _exit(code);
    }
    Child(Child&& from) noexcept : pid_(std::exchange(from.pid_, 0)) {}
    ~Child() {
        if (pid_ > 0) kill_now();
    }
    pid_t pid() const { return pid_; }
    void kill_now() {
        ::kill(pid_, SIGKILL);
        wait();
    }
    int wait() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = 0;
        return result_of(status);
    }
    /// Returns what wait() would return, if the process has ended.
    std::optional<int> ended() {
        int status = 0;
        if (pid_ != 0 && waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
        pid_ = 0;
        return result_of(status);
    }

  private:
    static int result_of(int status) {
        if (WIFEXITED(status)) return WEXITSTATUS(status);
        return WTERMSIG(status) == SIGKILL ? killed : crashed;
    }
    pid_t pid_;
};

/// Polls for a condition; generous, because the machine may be busy.
inline bool eventually(const std::function<bool()>& holds, std::chrono::nanoseconds bound = 20s) {
    const auto deadline = deadline_after(bound);
    while (!holds()) {
        if (now_ns() > deadline) return false;
        std::this_thread::sleep_for(200us);
    }
    return true;
}

/// TANDEM_STRESS=1000 reaches the largest size everywhere.
inline std::size_t stress(std::size_t usual) { return tandem::test::stress(usual); }
inline std::size_t stress(std::size_t usual, std::size_t largest) {
    return tandem::test::stress(usual, largest);
}

inline std::span<const std::byte> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}
inline std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace tandem::shm::test
