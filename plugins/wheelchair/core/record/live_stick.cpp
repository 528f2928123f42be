// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/live_stick.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace {

constexpr char stick_magic[8] = {'T', 'A', 'N', 'D', 'S', 'T', 'K', '\n'};

std::int64_t stick_clock_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

[[noreturn]] void fail_stick(const std::string& path, const char* what) {
    throw InputError("live stick " + path + ": " + what + ": " + std::strerror(errno));
}

double counts(double value) {
    const double end = JoystickParameters{}.max_count;
    return std::isfinite(value) ? std::clamp(std::round(value), -end, end) : 0.0;
}

} // namespace

LiveStick::LiveStick(const std::string& path, Role role) {
    const bool writes = role == Role::writer;
    const int flags = writes ? O_RDWR | O_CREAT | O_EXCL : O_RDONLY;
    const int fd = open(path.c_str(), flags | O_CLOEXEC, 0600);
    if (fd < 0) fail_stick(path, "cannot be opened");
    struct stat info {};
    const bool sized = writes ? ftruncate(fd, sizeof(LiveStickFile)) == 0
                              : fstat(fd, &info) == 0 && info.st_size == sizeof(LiveStickFile);
    void* const at = sized ? mmap(nullptr, sizeof(LiveStickFile), writes ? PROT_READ | PROT_WRITE : PROT_READ,
                                  MAP_SHARED | MAP_POPULATE, fd, 0)
                           : MAP_FAILED;
    close(fd);
    if (at == MAP_FAILED) fail_stick(path, "cannot be mapped");
    file_ = static_cast<LiveStickFile*>(at);
    if (writes) std::memcpy(file_->magic, stick_magic, sizeof stick_magic);
}

LiveStick::~LiveStick() { munmap(file_, sizeof(LiveStickFile)); }

void LiveStick::write(const JoystickPosition& position) {
    const auto version = file_->version.load(std::memory_order_relaxed);
    file_->version.store(version + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    file_->x.store(position.x, std::memory_order_relaxed);
    file_->y.store(position.y, std::memory_order_relaxed);
    file_->emergency_stop.store(position.emergency_stop ? 1.0 : 0.0, std::memory_order_relaxed);
    file_->time_ns.store(stick_clock_ns(), std::memory_order_relaxed);
    file_->version.store(version + 2, std::memory_order_release);
}

JoystickPosition LiveStick::read() const {
    // A writer that was stopped in the middle of a write is silent, too: the stick is released.
    for (int attempt = 0; attempt < 100; ++attempt) {
        const auto version = file_->version.load(std::memory_order_acquire);
        const JoystickPosition position{counts(file_->x.load(std::memory_order_relaxed)),
                                        counts(file_->y.load(std::memory_order_relaxed)),
                                        file_->emergency_stop.load(std::memory_order_relaxed) != 0.0};
        const auto time = file_->time_ns.load(std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_acquire);
        if (version % 2 != 0 || file_->version.load(std::memory_order_relaxed) != version) continue;
        if (stick_clock_ns() - time > stick_silence_ns) return {0.0, 0.0, position.emergency_stop};
        return position;
    }
    return {};
}

bool is_live_stick(const std::string& path) {
    char begin[sizeof stick_magic] = {};
    std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
    return std::memcmp(begin, stick_magic, sizeof begin) == 0;
}

} // namespace tandem::wheelchair
