// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/mapping.hpp"

#include "shm/os/error.hpp"
#include "shm/segment/liveness.hpp"

#include <sys/mman.h>
#include <sys/stat.h>

namespace tandem::shm {
namespace {

namespace ipc = boost::interprocess;

// The interface by which boost::interprocess::mapped_region maps a file that is open already.
struct Mappable {
    int fd;
    ipc::mapping_handle_t get_mapping_handle() const { return {fd, false}; }
};

bool has_holes(int fd, std::uint64_t bytes) {
    struct stat file {};
    constexpr std::uint64_t block = 512; // unit of st_blocks
    return fstat(fd, &file) == 0 && static_cast<std::uint64_t>(file.st_blocks) * block < bytes;
}

// MAP_POPULATE fills all page tables now, so that the data path takes no page fault. Not in a sparse segment,
// because it would allocate the memory that the segment is not to take yet.
ipc::mapped_region map_all(int fd, const std::string& path, std::uint64_t bytes, bool sparse) try {
    return {Mappable{fd},
            ipc::read_write,
            0,
            static_cast<std::size_t>(bytes),
            nullptr,
            sparse ? MAP_SHARED : MAP_SHARED | MAP_POPULATE};
} catch (const ipc::interprocess_exception& refused) {
    throw Error(path + ": " + std::to_string(bytes) + " bytes cannot be mapped (" + refused.what() +
                "); raise the limit on address space or locked memory");
}

} // namespace

Mapping::Mapping(FileDescriptor file, const std::string& path, const layout::SegmentHeader& checked,
                 Side side)
    : file_(std::move(file)), path_(path), sparse_(has_holes(file_.get(), checked.total_bytes)),
      region_(map_all(file_.get(), path, checked.total_bytes, sparse_)),
      guarded_(region_.get_address(), region_.get_size()), side_(side), generation_(checked.generation) {
    for (std::size_t i = 0; i < 2; ++i)
        arena_[i] = {at<std::byte>(checked.arena_offset[i]), checked.arena_bytes[i]};
    touch({at<const std::byte>(0), layout::arenas_begin});
}

void Mapping::touch(std::span<const std::byte> memory) const {
    if (!sparse_) return;
    for (std::size_t i = 0; i < memory.size(); i += layout::page)
        static_cast<void>(*static_cast<const volatile std::byte*>(&memory[i]));
}

bool Mapping::truncated() const {
    struct stat file {};
    return fstat(file_.get(), &file) == 0 && static_cast<std::uint64_t>(file.st_size) < region_.get_size();
}

PeerState Mapping::peer_state() const {
    const auto& peer = side_header(other(side_));
    // `taken` is set after the lock is held, so it must be read before the lock is looked at: the other way
    // round, a peer that joins between the two reads would look dead.
    if (peer.taken.load(std::memory_order_acquire) == 0) return PeerState::absent;
    return held_by_other(file_.get(), life_byte(other(side_))) ? PeerState::alive : PeerState::dead;
}

} // namespace tandem::shm
