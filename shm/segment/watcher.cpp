// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/watcher.hpp"

#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/syscall.h>

namespace tandem::shm {

Watcher::Watcher(const std::string& link)
    : link_(link), events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)),
      interrupt_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    check_link_name(link);
    if (!events_ || !interrupt_)
        throw Error("link '" + link + "': its segment cannot be watched (" + errno_text() +
                    "); raise fs.inotify.max_user_instances, or the limit on open files");
}

void Watcher::watch_file(int fd) {
    stop_watching();
    // By the descriptor, because the name may belong to another file by now. IN_ATTRIB: announce_change(), and the name
    // is removed. IN_MODIFY: truncated or superseded. IN_CLOSE_WRITE: the last reference to somebody's open file is
    // gone, however the process ended.
    constexpr std::uint32_t mask = IN_ATTRIB | IN_MODIFY | IN_CLOSE_WRITE;
    const std::string file = "/proc/self/fd/" + std::to_string(fd);
    file_watch_ = inotify_add_watch(events_.get(), file.c_str(), mask);
    if (file_watch_ < 0)
        throw Error("link '" + link_ + "': its segment cannot be watched (" + errno_text() +
                    "); raise fs.inotify.max_user_watches, and mount /proc");
}

std::optional<int> Watcher::watch_process(std::uint32_t pid) {
    process_ = FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, pid, 0)));
    return process_ ? std::nullopt : std::optional(errno);
}

void Watcher::stop_watching() {
    process_ = FileDescriptor();
    if (file_watch_ >= 0) inotify_rm_watch(events_.get(), file_watch_);
    file_watch_ = -1;
}

/// Reads all pending events, but those of a file that was watched before.
Watcher::Event Watcher::take_events() {
    alignas(inotify_event) char buffer[4096];
    Event found = Event::none;
    for (int reads = 0; reads < 1000; ++reads) {
        const ssize_t bytes = read(events_.get(), buffer, sizeof buffer);
        if (bytes <= 0) break;
        for (ssize_t at = 0; at < bytes;) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
            const bool lost_some = (event->mask & IN_Q_OVERFLOW) != 0;
            if (lost_some || (event->wd == file_watch_ && (event->mask & IN_CLOSE_WRITE) != 0))
                found = Event::departed;
            else if (event->wd == file_watch_ && found == Event::none)
                found = Event::changed;
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        }
    }
    return found;
}

Watcher::Event Watcher::wait(std::chrono::nanoseconds bound) {
    const std::uint64_t deadline = deadline_after(bound);
    for (;;) {
        std::uint64_t interrupts = 0;
        const bool interrupted = read(interrupt_.get(), &interrupts, sizeof interrupts) == sizeof interrupts;
        const Event event = take_events();
        if (event != Event::none || interrupted) return event == Event::none ? Event::changed : event;
        const std::uint64_t now = now_ns();
        if (now >= deadline) return Event::none;
        // ppoll() skips a descriptor of -1.
        pollfd sources[3] = {
            {events_.get(), POLLIN, 0}, {interrupt_.get(), POLLIN, 0}, {process_.get(), POLLIN, 0}};
        timespec left{};
        left.tv_sec = static_cast<time_t>((deadline - now) / 1'000'000'000ULL);
        left.tv_nsec = static_cast<long>((deadline - now) % 1'000'000'000ULL);
        if (ppoll(sources, 3, &left, nullptr) > 0 && sources[2].revents != 0) {
            process_ = FileDescriptor(); // it stays readable
            return Event::departed;
        }
    }
}

void Watcher::interrupt() {
    const std::uint64_t one = 1;
    // Fails only when 2^64 - 2 interrupts are pending.
    [[maybe_unused]] const auto written = write(interrupt_.get(), &one, sizeof one);
}

} // namespace tandem::shm
