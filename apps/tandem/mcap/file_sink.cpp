// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/file_sink.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tandem::mcap {
namespace {

constexpr std::size_t buffer_size = std::size_t{64} * 1024;

} // namespace

FileSink::FileSink(const std::filesystem::path& file, NewFile::Named named) : file_(file, named) {
    if (file_.is_regular()) disk_.emplace(file_.descriptor());
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
    if (!disk_) return;
    if (const int error = disk_->request(); error != 0) fail(error);
}

void FileSink::reserve(std::uint64_t size) {
    if (!failure_.empty()) throw Error(failure_);
    if (!file_.is_regular()) return;
    const std::uint64_t end = size_ + buffer_.size() + size;
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && end > limit.rlim_cur)
        fail(EFBIG);
    // Other errors mean that the file system cannot reserve room; writing then finds out.
    if (fallocate(file_.descriptor(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(size_),
                  static_cast<off_t>(end - size_)) != 0 &&
        (errno == ENOSPC || errno == EDQUOT))
        fail(errno);
}

bool FileSink::truncate(std::uint64_t size) {
    if (!file_.is_regular() || size > size_ || ftruncate(file_.descriptor(), static_cast<off_t>(size)) != 0 ||
        lseek(file_.descriptor(), static_cast<off_t>(size), SEEK_SET) < 0)
        return false;
    size_ = size;
    buffer_.clear();
    failure_.clear();
    return true;
}

void FileSink::close() {
    flush();
    if (disk_) {
        // Releases what reserve() has allocated after the end.
        if (ftruncate(file_.descriptor(), static_cast<off_t>(size_)) != 0) fail(errno);
        int error = disk_->stop();
        if (error == 0) error = sync_to_disk(file_.descriptor());
        disk_.reset();
        if (error != 0) fail(error);
    }
    file_.close();
}

void FileSink::discard() {
    disk_.reset();
    file_.discard();
}

void FileSink::write_out(ByteView bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file_.descriptor(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        size_ += static_cast<std::size_t>(written);
    }
}

void FileSink::fail(int error) {
    failure_ = file_.error(error).what();
    throw Error(failure_);
}

} // namespace tandem::mcap
