// SPDX-License-Identifier: Apache-2.0
#include "plugins/wheelchair/core/record/live_stick.hpp"

#include <boost/interprocess/file_mapping.hpp>
#include <fcntl.h>
#include <sys/mman.h>
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

namespace ipc = boost::interprocess;

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

/// With the size of a live stick, filled with zeros.
void create_stick(const std::string& path) {
    const int fd = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd < 0) fail_stick(path, "cannot be created");
    const bool sized = ftruncate(fd, sizeof(LiveStickFile)) == 0;
    close(fd);
    if (!sized) fail_stick(path, "cannot be created");
}

} // namespace

LiveStick::LiveStick(const std::string& path, Role role) {
    const bool writes = role == Role::writer;
    if (writes) create_stick(path);
    try {
        const auto mode = writes ? ipc::read_write : ipc::read_only;
        region_ =
            ipc::mapped_region(ipc::file_mapping(path.c_str(), mode), mode, 0, 0, nullptr, MAP_POPULATE);
    } catch (const ipc::interprocess_exception& error) {
        errno = error.get_native_error();
        fail_stick(path, "cannot be opened");
    }
    if (region_.get_size() != sizeof(LiveStickFile))
        throw InputError("live stick " + path + ": does not have the size of a live stick");
    file_ = static_cast<LiveStickFile*>(region_.get_address());
    if (writes) std::memcpy(file_->magic, stick_magic, sizeof stick_magic);
}

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
    // If the writer stopped during a write, the stick counts as released.
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
