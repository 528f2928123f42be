// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/log_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <poll.h>
#include <unistd.h>

namespace tandem::command {
namespace {

using namespace std::chrono_literals;
constexpr auto reader_patience = 1000ms;

auto count_lines(std::string_view text) {
    return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

} // namespace

/// Returns the number of bytes written. If not all of them could be written, sets error_.
std::size_t LogOutput::write_some(std::string_view text) {
    std::size_t written = 0;
    while (written < text.size()) {
        pollfd ready{descriptor_, POLLOUT, 0};
        const int found = poll(&ready, 1, static_cast<int>(patience_.count()));
        if (found < 0 && errno == EINTR) continue;
        // A ready pipe takes this many bytes without blocking.
        const ssize_t count = found == 0 ? -1
                                         : ::write(descriptor_, text.data() + written,
                                                   std::min<std::size_t>(text.size() - written, PIPE_BUF));
        if (count < 0 && found != 0 && errno == EINTR) continue;
        patience_ = count < 0 ? 0ms : reader_patience;
        if (count < 0) {
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
                       error_ == EAGAIN ? "no process reads it" : std::strerror(error_));
}

bool LogOutput::write(std::string_view lines) {
    if (error_ == EPIPE) return false;
    std::string head;
    if (missing_ > 0) head = fmt::format("{}{}: {}\n", mid_line_ ? "\n" : "", program_, notice());
    if (write_some(head) < head.size()) {
        missing_ += count_lines(lines);
    } else {
        missing_ = count_lines(lines.substr(write_some(lines)));
    }
    if (error_ == EPIPE) missing_ = 0; // there is no reader to inform
    return error_ != EPIPE;
}

} // namespace tandem::command
