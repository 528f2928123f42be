// SPDX-License-Identifier: Apache-2.0
#include "host/process/output_pipe.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace tandem::process {

OutputPipe::OutputPipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "no pipe to a child process");
    reader_ = FileDescriptor(ends[0]);
    writer_ = FileDescriptor(ends[1]);
    // Only the reading end is non-blocking: programs do not expect EAGAIN from writes to their standard output.
    fcntl(reader_.get(), F_SETFL, O_NONBLOCK);
}

bool OutputPipe::read_available(std::string& text) const {
    constexpr int max_reads = 4096; // a child that writes endlessly must not keep its reader in this loop
    std::array<char, 4096> chunk;
    for (int i = 0; i < max_reads; ++i) {
        const ssize_t count = read(reader_.get(), chunk.data(), chunk.size());
        if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
        text.append(chunk.data(), static_cast<std::size_t>(count));
    }
    return true;
}

} // namespace tandem::process
