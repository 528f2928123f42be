// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/read/file.hpp"

#include "apps/tandem/mcap/format/decode.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t window_size =
    std::uint64_t{64} * 1024; // read at once, because many records are small
constexpr std::uint64_t max_read = 1UL << 30U;

} // namespace

File::File(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat status {};
    if (descriptor_ < 0) throw error(std::string("cannot be opened: ") + std::strerror(errno));
    if (fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode)) {
        size_ = static_cast<std::uint64_t>(status.st_size);
        return;
    }
    ::close(descriptor_);
    throw error("cannot be read: it is not a regular file");
}

File::~File() { ::close(descriptor_); }

ByteView File::read(std::uint64_t offset, std::uint64_t size) {
    if (offset > size_ || size > size_ - offset)
        throw error("bytes from " + std::to_string(offset) + " on are after its end");
    if (size > max_read) throw error("the record at byte " + std::to_string(offset) + " has more than 1 GiB");
    const bool there = offset >= window_offset_ && offset - window_offset_ <= window_.size() &&
                       size <= window_.size() - (offset - window_offset_);
    if (!there) {
        window_.resize(std::max(size, std::min(window_size, size_ - offset)));
        window_offset_ = offset;
        std::size_t filled = 0;
        while (filled < window_.size()) {
            const ssize_t got = pread(descriptor_, window_.data() + filled, window_.size() - filled,
                                      static_cast<off_t>(offset + filled));
            if (got < 0 && errno == EINTR) continue;
            const int cause = errno;
            if (got <= 0) window_.clear();
            if (got < 0) throw error(std::string("cannot be read: ") + std::strerror(cause));
            if (got == 0) throw error("became shorter while it was read");
            filled += static_cast<std::size_t>(got);
        }
    }
    return ByteView(window_).subspan(offset - window_offset_, size);
}

std::optional<RecordPlace> File::record_at(std::uint64_t offset) {
    if (offset > size_ || size_ - offset < record_head_size) return {};
    FieldReader head(read(offset, record_head_size));
    const OpCode op{head.number<std::uint8_t>()};
    return RecordPlace{op, offset, head.number<std::uint64_t>()};
}

} // namespace tandem::mcap
