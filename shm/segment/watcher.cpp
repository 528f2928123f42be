// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/watcher.hpp"

#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/syscall.h>

namespace tandem::shm {

Watcher::Watcher(const std::string& link)
    : interrupt_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)), sources_(epoll_create1(EPOLL_CLOEXEC)),
      file_("link '" + link + "': its segment", interrupt_.get()) {
    check_link_name(link);
    // An event wakes one of the threads that sleep on the shared inotify instance; it passes the event to the others.
    if (!interrupt_ || !sources_ || !add(interrupt_.get(), EPOLLIN) ||
        !add(file_.fd(), EPOLLIN | EPOLLEXCLUSIVE))
        throw Error("link '" + link + "': its segment cannot be watched (" + errno_text() +
                    "); raise the limit on open files");
}

bool Watcher::add(int fd, std::uint32_t events) const {
    epoll_event event{};
    event.events = events;
    event.data.fd = fd;
    return epoll_ctl(sources_.get(), EPOLL_CTL_ADD, fd, &event) == 0;
}

/// A child process that is being started may have inherited the descriptor, so closing it would not remove the source.
void Watcher::forget_process() {
    if (process_) epoll_ctl(sources_.get(), EPOLL_CTL_DEL, process_.get(), nullptr);
    process_ = FileDescriptor();
}

// IN_ATTRIB: announce_change() was called, or the name was removed. IN_MODIFY: truncated or superseded. IN_CLOSE_WRITE: the
// last reference to an open file is gone, however its process ended.
void Watcher::start_watching(int fd) {
    stop_watching();
    file_.start(fd, IN_ATTRIB | IN_MODIFY | IN_CLOSE_WRITE);
}

std::optional<int> Watcher::watch_process(std::uint32_t pid) {
    forget_process();
    process_ = FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, pid, 0)));
    return process_ && add(process_.get(), EPOLLIN) ? std::nullopt : std::optional(errno);
}

void Watcher::stop_watching() {
    forget_process();
    file_.stop();
}

Watcher::Event Watcher::take_events() {
    const std::uint32_t events = file_.take();
    if ((events & (IN_CLOSE_WRITE | IN_Q_OVERFLOW)) != 0) return Event::departed;
    return events != 0 ? Event::changed : Event::none;
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
        constexpr std::uint64_t longest_ms = 1'000'000'000; // checks again after 11 days
        const std::uint64_t left_ms = std::min((deadline - now + 999'999) / 1'000'000, longest_ms);
        epoll_event happened[3];
        const int count = epoll_wait(sources_.get(), happened, 3, static_cast<int>(left_ms));
        const bool ended = std::any_of(happened, happened + std::max(count, 0), [this](const auto& source) {
            return process_ && source.data.fd == process_.get();
        });
        if (ended) {
            forget_process(); // the pidfd stays readable
            take_events();    // this thread may have been woken for the events of others
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
