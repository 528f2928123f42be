// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/os/close_on_fork_descriptor.hpp"
#include "shm/os/error.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"
#include "shm/segment/directory.hpp"
#include "shm/segment/process_identity.hpp"
#include "shm/segment/segment_file.hpp"
#include "shm/segment/watcher.hpp"
#include "shm/wait/doorbell.hpp"

namespace tandem::shm {

struct JoinOptions {
    /// Minimum size of this side's arena, and of the peer's arena if this side creates the segment. Bytes.
    std::size_t arena_bytes = std::size_t{4} << 20;
    /// Additional size of this side's arena, for the chunks of rings and for many objects. Bytes.
    std::size_t chunk_pool_bytes = 0;
    /// Additional size of the peer's arena if this side creates the segment. Bytes.
    std::size_t peer_chunk_pool_bytes = 0;
    /// Applies if this side creates the segment. The memory of the arenas is not reserved in advance; only the room for
    /// arena_bytes each is checked. An object gets its memory when it is added. The records of a ring, chunks and the overflow
    /// buffers of calls get their memory at first use.
    bool sparse = false;
    std::uint64_t contract =
        0;             ///< version of the users' agreement; segments with another version are refused
    std::string group; ///< if not empty: the file has mode 0660 and this group
};

/// One generation of a link, seen from one side. Join, add objects and publish(); after the peer has published, find the
/// objects of the peer. Only one thread at a time may set up. Each object that is found has its own thread rules.
class Segment {
  public:
    /// Attaches to the newest generation in which the peer is alive and this side was never taken; otherwise creates the next
    /// generation. Removes generations without a living side. Ignores files of other users. Never waits for the peer. Throws SideTaken if a living process
    /// holds this side, Error for any other obstacle.
    static std::unique_ptr<Segment> join(const std::string& link, Side side, const JoinOptions& options = {});

    ~Segment(); ///< Calls leave().
    Segment(const Segment&) = delete;
    Segment& operator=(const Segment&) = delete;

    /// [any-thread] Gives this side back and tells the peer. The last side to leave removes the file. The memory stays mapped
    /// while this object, or a ring, call queue or doorbell of it, exists.
    void leave();

    std::uint64_t generation() const { return mapping_->generation(); }
    Side side() const { return mapping_->side(); }
    const std::string& path() const { return mapping_->path(); }
    /// Returns a file that join() has ignored, because it has a name of this link and belongs to another user; empty: none.
    const std::string& ignored_file() const { return ignored_file_; }

    /// [any-thread] Returns whether the peer is absent, alive or dead. Makes up to ten system calls: for a supervisor, not for
    /// the data path.
    PeerState peer_state() const { return mapping_->peer_state(); }
    /// [any-thread] Mapping::peer_state_by_lock(): one system call: call it every 5 ms, not for every message.
    PeerState peer_state_by_lock() const { return mapping_->peer_state_by_lock(); }
    std::size_t arena_bytes(Side owner) const { return mapping_->arena(owner).size(); }
    ProcessIdentity peer_process() const; ///< Returns what the peer wrote; empty before it has joined.
    /// [any-thread] Makes the watcher watch this generation. Throws Error.
    void watch(Watcher& watcher) const { watcher.start_watching(mapping_->fd()); }

    /// [any-thread] Returns whether a newer generation exists, or the file was removed or truncated. If so, leave and join
    /// again. Makes two system calls.
    bool superseded() const;
    bool truncated() const { return mapping_->truncated(); } ///< [any-thread]

    /// Adds an object of this side, which the peer sees after publish(). `name` has at most 103 characters and is unique on
    /// this side. Throws Error if the arena or the directory is full, or if the name or an option is invalid.
    RingHandle add_ring(const std::string& name, const RingOptions& options);
    CallQueueHandle add_call_queue(const std::string& name, const CallQueueOptions& options);
    std::span<std::byte> add_blob(const std::string& name, std::size_t bytes); ///< zero-filled, 128-aligned

    /// Makes all objects added so far visible and tells the peer. May be called again after more objects were added.
    void publish();
    bool peer_published() const;

    /// Returns an object of either side by its name; empty if the object does not exist (yet). Throws Error if the peer has
    /// damaged the object.
    std::optional<RingHandle> find_ring(Side owner, const std::string& name) const;
    std::optional<CallQueueHandle> find_call_queue(Side owner, const std::string& name) const;
    std::optional<std::span<std::byte>> find_blob(Side owner, const std::string& name) const;
    /// Returns a copy, which the peer cannot change while the caller parses it. Throws Error if the file has less memory than
    /// the blob claims.
    std::optional<std::vector<std::byte>> copy_blob(Side owner, const std::string& name) const;
    std::vector<ObjectInfo> list(Side owner) const;

    /// [any-thread] Ends all sleeps of this process in this segment, so that each wait checks its condition again. This includes
    /// sleeps on words that nobody can wake any more because the file was truncated.
    void end_sleeps() const;

    Doorbell& doorbell() { return doorbell_; }
    Doorbell& peer_doorbell() { return peer_doorbell_; }
    bool ring_peer(unsigned bit) {
        return peer_doorbell_.ring(bit);
    } ///< Returns true if the peer was asleep.

  private:
    friend class SegmentJoiner;
    Segment(std::shared_ptr<const Mapping> mapping, std::unique_ptr<CloseOnForkDescriptor> life_lock);

    std::shared_ptr<const Mapping> mapping_;
    Directory directory_;
    Doorbell doorbell_, peer_doorbell_;
    std::unique_ptr<CloseOnForkDescriptor> life_lock_; ///< holds the lock of this side
    std::atomic<bool> left_{false};
    bool has_loans_[2] = {false, false}; ///< by calling side: a call queue was added whose calls may be long
    std::string ignored_file_;
};

} // namespace tandem::shm
