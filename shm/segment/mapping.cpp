// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/mapping.hpp"

#include "shm/segment/liveness.hpp"

#include <sys/stat.h>

namespace tandem::shm {
namespace {

/// Returns `unknown` if the system does not tell.
std::uint64_t memory_of(int fd, std::uint64_t unknown) {
    struct stat file {};
    constexpr std::uint64_t block = 512; // unit of st_blocks
    return fstat(fd, &file) == 0 ? static_cast<std::uint64_t>(file.st_blocks) * block : unknown;
}

bool has_holes(int fd, std::uint64_t bytes) { return memory_of(fd, bytes) < bytes; }

} // namespace

Mapping::Mapping(FileDescriptor file, const std::string& path, const layout::SegmentHeader& checked,
                 Side side)
    : file_(std::move(file)), path_(path), sparse_(has_holes(file_.get(), checked.total_bytes)),
      region_(file_.get(), path, static_cast<std::size_t>(checked.total_bytes), sparse_),
      guarded_(region_.address(), region_.size()), side_(side), generation_(checked.generation) {
    for (std::size_t i = 0; i < 2; ++i)
        arena_[i] = {at<std::byte>(checked.arena_offset[i]), checked.arena_bytes[i]};
    touch({at<const std::byte>(0), layout::arenas_begin});
}

void Mapping::touch(std::span<const std::byte> memory) const {
    if (!sparse_) return;
    for (std::size_t i = 0; i < memory.size(); i += layout::page)
        static_cast<void>(*static_cast<const volatile std::byte*>(&memory[i]));
}

std::uint64_t Mapping::memory_bytes() const { return memory_of(file_.get(), 0); }

bool Mapping::truncated() const {
    struct stat file {};
    return fstat(file_.get(), &file) == 0 && static_cast<std::uint64_t>(file.st_size) < region_.size();
}

PeerState Mapping::peer_state() const {
    const PeerState by_lock = peer_state_by_lock();
    if (by_lock != PeerState::alive) return by_lock;
    return process_has_ended(file_.get(), other(side_)) ? PeerState::dead : PeerState::alive;
}

PeerState Mapping::peer_state_by_lock() const {
    const auto& peer = side_header(other(side_));
    // The joining side sets `taken` while it holds the lock. So `taken` is read before the lock is checked: in the other
    // order, a peer that joins between the two reads would appear dead.
    if (peer.taken.load(std::memory_order_acquire) == 0) return PeerState::absent;
    return held_by_other(file_.get(), life_byte(other(side_))) ? PeerState::alive : PeerState::dead;
}

} // namespace tandem::shm
