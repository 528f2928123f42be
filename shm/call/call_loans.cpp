// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_loans.hpp"

#include "shm/call/file_limit.hpp"
#include "shm/segment/layout.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tandem::shm {
namespace {

/// Calls `copy(done)`, which moves bytes after the first `done` ones, until all are moved. Returns false if it moves none.
template <class Copy>
bool copy_all(std::size_t bytes, Copy&& copy) {
    for (std::size_t done = 0; done < bytes;) {
        const ssize_t moved = copy(done);
        if (moved > 0)
            done += static_cast<std::size_t>(moved);
        else if (moved == 0 || errno != EINTR)
            return false;
    }
    return true;
}

} // namespace

bool exceeds_file_limit(const CallLoans& loans, std::uint32_t slot, std::size_t bytes) {
    rlimit limit{};
    return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
           loans.begin + slot * loans.stride + bytes > limit.rlim_cur;
}

bool CallLoans::write(std::uint32_t slot, const void* from, std::size_t bytes) const {
    const std::uint64_t offset = offset_of(slot);
    const bool written = !exceeds_file_limit(*this, slot, bytes) && copy_all(bytes, [&](std::size_t done) {
        return pwrite(file, static_cast<const std::byte*>(from) + done, bytes - done,
                      static_cast<off_t>(offset + done));
    });
    if (!written) give_back(slot);
    return written;
}

bool CallLoans::has(std::uint32_t slot, std::size_t bytes) const {
    const auto offset = static_cast<off_t>(offset_of(slot));
    return lseek(file, offset, SEEK_HOLE) >= offset + static_cast<off_t>(bytes);
}

bool CallLoans::read(std::uint32_t slot, void* to, std::size_t bytes) const {
    const std::uint64_t offset = offset_of(slot);
    return copy_all(bytes, [&](std::size_t done) {
        return pread(file, static_cast<std::byte*>(to) + done, bytes - done,
                     static_cast<off_t>(offset + done));
    });
}

void CallLoans::give_back(std::uint32_t slot) const {
    fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset_of(slot)),
              static_cast<off_t>(layout::max_loan_bytes));
}

} // namespace tandem::shm
