// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/shared_memory/shared_message.hpp"
#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <coil/UUID.h>
#include <cstdint>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace RTC {
namespace {

constexpr std::size_t header_bytes = sizeof(std::uint64_t);
constexpr unsigned long long default_size = 2ULL << 20U; // OpenRTM-aist's
constexpr std::uint64_t max_message = 1ULL << 28U;       // what a peer can make this process allocate

// The conversion is the same in both directions.
std::uint64_t in_byte_order(std::uint64_t value, bool little_endian) {
    const bool native = little_endian == (std::endian::native == std::endian::little);
    return native ? value : __builtin_bswap64(value);
}

void close_descriptor(int& descriptor) {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = -1;
}

// Objects of other programs have names of another form: a peer must not make this process read or remove them.
bool is_uuid(const std::string& name) {
    return name.size() == 36 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return std::isxdigit(c) != 0 || c == '-';
           });
}

} // namespace

bool SharedMessageWriter::fits(unsigned long length) const {
    return descriptor_ >= 0 && header_bytes + length <= size_;
}

// The size takes no memory; only written data does. A message that has grown may grow again.
bool SharedMessageWriter::create(unsigned long length) {
    remove();
    coil::UUID_Generator generator;
    name_ = generator.generateUUID()->to_string();
    size_ = std::max<unsigned long long>(default_size, 2 * (header_bytes + length));
    descriptor_ = ::shm_open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size_)) == 0) return true;
    remove();
    return false;
}

bool SharedMessageWriter::write(const ByteData& bytes) {
    if (!fits(bytes.getDataLength())) return false;
    std::uint64_t length = in_byte_order(bytes.getDataLength(), bytes.getEndian());
    const iovec parts[] = {{&length, sizeof length}, {bytes.getBuffer(), bytes.getDataLength()}};
    return ::pwritev(descriptor_, parts, 2, 0) == static_cast<ssize_t>(header_bytes + bytes.getDataLength());
}

void SharedMessageWriter::remove() {
    if (descriptor_ >= 0) ::shm_unlink(name_.c_str());
    close_descriptor(descriptor_);
    size_ = 0;
}

bool SharedMessageReader::open(const std::string& name) {
    close();
    errno = EINVAL;
    if (!is_uuid(name)) return false;
    descriptor_ = ::shm_open(name.c_str(), O_RDONLY | O_CLOEXEC, 0);
    if (descriptor_ < 0) return false;
    name_ = name;
    return true;
}

void SharedMessageReader::close() { close_descriptor(descriptor_); }

bool SharedMessageReader::read(ByteData& bytes, bool little_endian) const {
    std::uint64_t length = 0;
    struct stat state {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &state) != 0 ||
        ::pread(descriptor_, &length, sizeof length, 0) != static_cast<ssize_t>(sizeof length))
        return false;
    length = in_byte_order(length, little_endian);
    const auto size = static_cast<std::uint64_t>(state.st_size);
    if (length > max_message || size < header_bytes || length > size - header_bytes) return false;
    bytes.setDataLength(length);
    return ::pread(descriptor_, bytes.getBuffer(), length, header_bytes) == static_cast<ssize_t>(length);
}

void SharedMessageReader::remove_name() {
    if (!name_.empty()) ::shm_unlink(name_.c_str());
    name_.clear();
}

} // namespace RTC
