// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/file_descriptor.hpp"
#include "shm/segment/layout.hpp"
#include "shm/segment/mapped_file.hpp"
#include "shm/segment/side.hpp"
#include "shm/segment/truncation_guard.hpp"

#include <span>
#include <string>

namespace tandem::shm {

/// A segment's memory as one side sees it, with a private copy of all sizes. Segment and all of its rings, call queues and
/// doorbells share one Mapping, so the memory stays mapped while one of them may access it.
class Mapping {
  public:
    /// `checked` is the header from read_header(). Throws Error if the file cannot be mapped.
    Mapping(FileDescriptor file, const std::string& path, const layout::SegmentHeader& checked, Side side);

    int fd() const { return file_.get(); }
    const std::string& path() const { return path_; }
    Side side() const { return side_; }
    std::uint64_t generation() const { return generation_; }

    layout::SegmentHeader& header() const { return *at<layout::SegmentHeader>(0); }
    layout::SideHeader& side_header(Side side) const {
        return *at<layout::SideHeader>(sizeof(layout::SegmentHeader) +
                                       index_of(side) * sizeof(layout::SideHeader));
    }
    std::span<const std::byte> memory() const { return {region_.address(), region_.size()}; }
    std::span<std::byte> arena(Side side) const { return arena_[index_of(side)]; }

    /// [any-thread] Returns the state of the peer. Makes up to ten system calls.
    PeerState peer_state() const;

    /// [any-thread] Like peer_state(), for the data path: makes at most one system call. A peer whose process has ended is
    /// alive as long as a child of clone() holds its lock.
    PeerState peer_state_by_lock() const;

    /// [any-thread] Returns the memory that the file takes; a sparse file takes less than its size. Makes one system call.
    std::uint64_t memory_bytes() const;

    /// [any-thread] Returns whether the file is shorter than the mapping. Makes one system call.
    bool truncated() const;

    /// Returns whether parts of the file have no memory yet (JoinOptions::sparse). The side that adds an object reserves its
    /// memory, and each side touches this memory, so that the data path causes no page fault.
    bool sparse() const { return sparse_; }
    /// Reads one byte of each page if the segment is sparse.
    void touch(std::span<const std::byte> memory) const;
    std::uint64_t offset_in_file(const std::byte* memory) const {
        return static_cast<std::uint64_t>(memory - region_.address());
    }

  private:
    template <class T>
    T* at(std::size_t offset) const {
        return reinterpret_cast<T*>(region_.address() + offset);
    }

    FileDescriptor file_;
    std::string path_;
    bool sparse_;
    MappedFile region_;
    TruncationGuardedRange guarded_;
    std::span<std::byte> arena_[2];
    Side side_;
    std::uint64_t generation_;
};

} // namespace tandem::shm
