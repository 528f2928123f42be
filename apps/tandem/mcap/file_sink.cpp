// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/file_sink.hpp"

#include "host/process/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::mcap {
namespace {

constexpr std::size_t buffer_size = std::size_t{64} * 1024;

} // namespace

FileSink::FileSink(std::filesystem::path file)
    : file_(std::move(file)), descriptor_(process::open_output(file_, process::Existing::keep)) {
    struct stat status {};
    if (fstat(descriptor_.get(), &status) != 0) fail(errno);
    if (S_ISREG(status.st_mode) && status.st_size > 0)
        throw Error(file_.string() + " already exists and is not empty: give another file, or remove it");
    buffer_.reserve(buffer_size);
}

void FileSink::write(ByteView bytes) {
    if (!failure_.empty()) throw Error(failure_);
    if (bytes.size() > buffer_size - buffer_.size()) {
        flush();
        if (bytes.size() > buffer_size) return write_out(bytes);
    }
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

void FileSink::flush() {
    if (!failure_.empty()) throw Error(failure_);
    write_out(buffer_);
    buffer_.clear();
}

void FileSink::close() {
    flush();
    if (descriptor_ && ::close(descriptor_.release()) != 0) fail(errno);
}

void FileSink::write_out(ByteView bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void FileSink::fail(int error) {
    failure_ = file_.string() + " cannot be written: " + std::strerror(error);
    throw Error(failure_);
}

} // namespace tandem::mcap
