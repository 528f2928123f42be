// SPDX-License-Identifier: Apache-2.0
#include "host/log/log_output.hpp"

#include "shm/os/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace tandem::log {
namespace {

auto count_lines(std::string_view text) {
    return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A pipe or terminal that takes some bytes may still block the write of more. O_NONBLOCK prevents this, but belongs to the open
/// file, which other processes share. So the file is opened once more. Returns nullptr if this is impossible, or useless
/// as for a file on a disk.
std::unique_ptr<shm::CloseOnForkDescriptor> open_nonblocking(int descriptor) {
    struct stat file {};
    if (fstat(descriptor, &file) != 0 || !(S_ISFIFO(file.st_mode) || S_ISCHR(file.st_mode))) return nullptr;
    try {
        return std::make_unique<shm::CloseOnForkDescriptor>("/proc/self/fd/" + std::to_string(descriptor),
                                                            O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    } catch (const shm::Error&) { // for example a FIFO without a reader
        return nullptr;
    }
}

} // namespace

LogOutput::LogOutput(int descriptor, std::string program, std::chrono::milliseconds patience)
    : descriptor_(descriptor), nonblocking_(open_nonblocking(descriptor)), program_(std::move(program)),
      patience_(patience) {
    // The kernel's buffer lets a reader fall behind for a while. The limit of an unprivileged user is usually 1 MiB.
    constexpr int pipe_bytes = 1 << 20;
    if (fcntl(descriptor, F_GETPIPE_SZ) < pipe_bytes) fcntl(descriptor, F_SETPIPE_SZ, pipe_bytes);
}

LogOutput::~LogOutput() {
    if (missing_ > 0) write("");
}

/// Returns the number of bytes written. If not all of them could be written, sets error_.
std::size_t LogOutput::write_some(std::string_view text) {
    const int file = nonblocking_ && *nonblocking_ ? nonblocking_->get() : descriptor_;
    std::size_t written = 0;
    while (written < text.size()) {
        pollfd ready{file, POLLOUT, 0};
        const int found = poll(&ready, 1, stalled_ ? 0 : static_cast<int>(patience_.count()));
        if (found < 0 && errno == EINTR) continue;
        // A ready pipe takes this many bytes without blocking.
        const ssize_t count = found == 0 ? -1
                                         : ::write(file, text.data() + written,
                                                   std::min<std::size_t>(text.size() - written, PIPE_BUF));
        if (count < 0 && found != 0 && errno == EINTR) continue;
        stalled_ = count < 0;
        if (stalled_) {
            error_ = found == 0 ? EAGAIN : errno;
            break;
        }
        written += static_cast<std::size_t>(count);
    }
    if (written > 0) mid_line_ = text[written - 1] != '\n';
    return written;
}

std::string LogOutput::notice() const {
    return fmt::format("{} lines of the log could not be written ({})", missing_,
                       error_ == EAGAIN || error_ == EPIPE ? "no process reads it" : std::strerror(error_));
}

bool LogOutput::write(std::string_view lines) {
    std::string head;
    if (missing_ > 0) head = fmt::format("{}{}: {}\n", mid_line_ ? "\n" : "", program_, notice());
    if (write_some(head) < head.size()) {
        missing_ += count_lines(lines);
    } else {
        missing_ = count_lines(lines.substr(write_some(lines)));
    }
    return !stalled_ || error_ != EPIPE;
}

} // namespace tandem::log
