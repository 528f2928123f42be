// SPDX-License-Identifier: Apache-2.0
#include "apps/hosts/input_relay.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace tandem::hosts {

InputRelay::InputRelay(int source) : source_(source) {
    std::signal(SIGTTIN, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN); // a receiver may end
}

process::FileDescriptor InputRelay::add_receiver() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::runtime_error(std::string("cannot create a pipe for a host's input: ") +
                                 std::strerror(errno));
    process::FileDescriptor reader(ends[0]), writer(ends[1]);
    fcntl(writer.get(), F_SETFL, O_NONBLOCK);
    if (source_ >= 0) receivers_.push_back(std::move(writer));
    return reader;
}

void InputRelay::forward() {
    std::array<char, 4096> text{};
    const auto size = read(source_, text.data(), text.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) return;
    if (size <= 0) { // end of the input, or this program is in the background
        source_ = -1;
        receivers_.clear();
        return;
    }
    std::erase_if(receivers_, [&](const process::FileDescriptor& receiver) {
        return write(receiver.get(), text.data(), static_cast<std::size_t>(size)) < 0 && errno == EPIPE;
    });
}

} // namespace tandem::hosts
