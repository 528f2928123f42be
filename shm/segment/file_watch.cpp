// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/file_watch.hpp"

#include "shm/os/error.hpp"

#include <algorithm>
#include <mutex>
#include <sys/inotify.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace tandem::shm {

/// The inotify instance of this process. It exists while the process watches a file.
class FileWatch::Instance {
  public:
    static std::shared_ptr<Instance> shared() {
        static std::mutex creation;
        static std::weak_ptr<Instance> current;
        const std::lock_guard lock(creation);
        auto found = current.lock();
        if (!found) current = found = std::make_shared<Instance>();
        return found;
    }

    /// Passes all pending events to the watches of their files.
    void read_events() {
        alignas(inotify_event) char buffer[4096];
        for (int reads = 0; reads < 1000; ++reads) {
            const ssize_t bytes = read(events.get(), buffer, sizeof buffer);
            if (bytes <= 0) return;
            for (ssize_t at = 0; at < bytes;) {
                const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
                for (auto* watch : watches)
                    if (watch->watch_ == event->wd || (event->mask & IN_Q_OVERFLOW) != 0)
                        watch->pending_ |= event->mask;
                at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        }
    }

    /// Wakes the threads of all watches with pending events, except `caller`.
    void signal_all_but(const FileWatch* caller) {
        for (auto* watch : watches) {
            constexpr std::uint64_t one = 1;
            // Fails only when 2^64 - 2 signals are pending.
            if (watch != caller && watch->pending_ != 0 && !std::exchange(watch->signalled_, true))
                [[maybe_unused]]
                const auto written = write(watch->signal_, &one, sizeof one);
        }
    }

    FileDescriptor events{inotify_init1(IN_NONBLOCK | IN_CLOEXEC)};
    const std::string error = events ? "" : errno_text(); ///< why events cannot be read
    std::mutex mutex;                                     ///< guards the watches and their pending events
    std::vector<FileWatch*> watches;
};

FileWatch::FileWatch(std::string what, int signal)
    : what_(std::move(what)), signal_(signal), instance_(Instance::shared()) {
    if (!instance_->events)
        throw Error(what_ + " cannot be watched (" + instance_->error +
                    "); raise fs.inotify.max_user_instances");
}

FileWatch::~FileWatch() { stop(); }

void FileWatch::start(int fd, std::uint32_t mask) {
    stop();
    const std::lock_guard lock(instance_->mutex);
    // Opens by the descriptor, because the name may belong to another file by now.
    const std::string file = "/proc/self/fd/" + std::to_string(fd);
    watch_ = inotify_add_watch(instance_->events.get(), file.c_str(), mask);
    if (watch_ < 0)
        throw Error(what_ + " cannot be watched (" + errno_text() +
                    "); raise fs.inotify.max_user_watches, and mount /proc");
    pending_ = 0;
    signalled_ = false;
    instance_->watches.push_back(this);
}

void FileWatch::stop() {
    if (watch_ < 0) return;
    const std::lock_guard lock(instance_->mutex);
    auto& watches = instance_->watches;
    std::erase(watches, this);
    // This thread may have been woken for the events of other watches.
    instance_->read_events();
    instance_->signal_all_but(nullptr);
    // Two sides of a link in one process watch the same file, and inotify has one watch for both.
    if (std::none_of(watches.begin(), watches.end(), [this](auto* other) { return other->watch_ == watch_; }))
        inotify_rm_watch(instance_->events.get(), watch_);
    watch_ = -1;
}

int FileWatch::fd() const { return instance_->events.get(); }

std::uint32_t FileWatch::take() {
    const std::lock_guard lock(instance_->mutex);
    instance_->read_events();
    instance_->signal_all_but(this);
    signalled_ = false;
    return std::exchange(pending_, 0);
}

} // namespace tandem::shm
