// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/disk_sync.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <unistd.h>

namespace tandem::mcap {
namespace {

constexpr std::chrono::seconds shortest_interval{1};

} // namespace

int sync_to_disk(int descriptor) {
    if (fdatasync(descriptor) == 0) return 0;
    return errno == EINVAL || errno == EROFS || errno == ENOSYS ? 0 : errno;
}

DiskSync::DiskSync(int descriptor) : descriptor_(descriptor) {
    // Signals are for the threads of the program.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
        thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) { // the limit of threads: the file is synchronized at its end
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

int DiskSync::request() {
    const std::lock_guard lock(mutex_);
    requested_ = true;
    changed_.notify_one();
    return error_;
}

int DiskSync::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        changed_.notify_one();
    }
    if (thread_.joinable()) thread_.join();
    return error_;
}

void DiskSync::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return requested_ || stopping_; });
        if (stopping_) return;
        requested_ = false;
        lock.unlock();
        const int error = sync_to_disk(descriptor_);
        lock.lock();
        if (error_ == 0) error_ = error;
        changed_.wait_for(lock, shortest_interval, [this] { return stopping_; });
    }
}

} // namespace tandem::mcap
