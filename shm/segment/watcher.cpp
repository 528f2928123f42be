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
    : interrupt_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      file_("link '" + link + "': its segment", interrupt_.get()) {
    check_link_name(link);
    if (!interrupt_)
        throw Error("link '" + link + "': its segment cannot be watched (" + errno_text() +
                    "); raise the limit on open files");
}

// IN_ATTRIB: announce_change(), and the name is removed. IN_MODIFY: truncated or superseded. IN_CLOSE_WRITE: the last
// reference to somebody's open file is gone, however the process ended.
void Watcher::watch_file(int fd) {
    stop_watching();
    file_.start(fd, IN_ATTRIB | IN_MODIFY | IN_CLOSE_WRITE);
}

std::optional<int> Watcher::watch_process(std::uint32_t pid) {
    process_ = FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, pid, 0)));
    return process_ ? std::nullopt : std::optional(errno);
}

void Watcher::stop_watching() {
    process_ = FileDescriptor();
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
        // ppoll() skips a descriptor of -1.
        pollfd sources[3] = {
            {file_.fd(), POLLIN, 0}, {interrupt_.get(), POLLIN, 0}, {process_.get(), POLLIN, 0}};
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
