// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/watcher.hpp"

#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <cstring>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>

namespace tandem::shm {

Watcher::Watcher(const std::string& link)
    : prefix_(file_prefix(link)), events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      interrupt_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    check_link_name(link);
    // IN_CLOSE_WRITE: the last reference to a side's open file is gone, however its process ended.
    constexpr std::uint32_t mask = IN_CREATE | IN_MOVED_TO | IN_CLOSE_WRITE | IN_DELETE;
    if (!events_ || !interrupt_ || inotify_add_watch(events_.get(), shm_directory, mask) < 0)
        throw Error("link '" + link + "': " + shm_directory + " cannot be watched (" + errno_text() +
                    "); raise fs.inotify.max_user_instances or max_user_watches");
}

/// Reads all pending events. True: one of them is about this link, or some were lost.
bool Watcher::take_events() {
    alignas(inotify_event) char buffer[4096];
    bool relevant = false;
    for (int reads = 0; reads < 1000; ++reads) {
        const ssize_t bytes = read(events_.get(), buffer, sizeof buffer);
        if (bytes <= 0) break;
        for (ssize_t at = 0; at < bytes;) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
            const bool lost_some = (event->mask & IN_Q_OVERFLOW) != 0;
            if (lost_some ||
                (event->len > 0 && std::strncmp(event->name, prefix_.c_str(), prefix_.size()) == 0))
                relevant = true;
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        }
    }
    return relevant;
}

bool Watcher::wait(std::chrono::nanoseconds bound) {
    const std::uint64_t deadline = deadline_after(bound);
    for (;;) {
        std::uint64_t interrupts = 0;
        if (read(interrupt_.get(), &interrupts, sizeof interrupts) == sizeof interrupts || take_events())
            return true;
        const std::uint64_t now = now_ns();
        if (now >= deadline) return false;
        pollfd sources[2] = {{events_.get(), POLLIN, 0}, {interrupt_.get(), POLLIN, 0}};
        timespec left{};
        left.tv_sec = static_cast<time_t>((deadline - now) / 1'000'000'000ULL);
        left.tv_nsec = static_cast<long>((deadline - now) % 1'000'000'000ULL);
        ppoll(sources, 2, &left, nullptr);
    }
}

void Watcher::interrupt() {
    const std::uint64_t one = 1;
    // Fails only when 2^64 - 2 interrupts are pending.
    [[maybe_unused]] const auto written = write(interrupt_.get(), &one, sizeof one);
}

} // namespace tandem::shm
