// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/os/close_on_fork_descriptor.hpp"
#include "shm/os/error.hpp"
#include "shm/ring/ring_reader.hpp"
#include "shm/ring/ring_writer.hpp"
#include "shm/segment/directory.hpp"
#include "shm/segment/segment_file.hpp"
#include "shm/segment/watcher.hpp"
#include "shm/wait/doorbell.hpp"

namespace tandem::shm {

struct JoinOptions {
    /// Wanted at least for the own arena, and for the peer's, if this side creates the segment.
    std::size_t arena_bytes = std::size_t{4} << 20;
    /// Wanted in addition to that in the own arena, for the chunks of rings and for many objects.
    std::size_t chunk_pool_bytes = 0;
    /// The same in the peer's arena, if this side creates the segment.
    std::size_t peer_chunk_pool_bytes = 0;
    /// If this side creates the segment: no memory of the arenas is reserved in advance (only whether there
    /// is room for arena_bytes each is checked). An object gets its memory when it is added, but the records of a
    /// ring, chunks, and what holds long calls get theirs when they are first used.
    bool sparse = false;
    std::uint64_t contract =
        0;             ///< version of the users' own agreement; a segment with another one is refused
    std::string group; ///< if not empty: mode 0660, owned by that group
};

/// One generation of a link, seen from one side. Join, add objects, publish(); when the peer has published,
/// find its objects. Calls that set up: one thread at a time; the objects found have rules of their own.
class Segment {
  public:
    /// Attaches to the newest generation in which the peer lives and this side was never taken, otherwise
    /// creates the next one; removes those in which no side lives. Never waits for the peer. Throws SideTaken
    /// if this side is held by a living process, Error for any other obstacle.
    static std::unique_ptr<Segment> join(const std::string& link, Side side, const JoinOptions& options = {});

    ~Segment(); ///< leave()
    Segment(const Segment&) = delete;
    Segment& operator=(const Segment&) = delete;

    /// [any-thread] Gives this side back and tells the peer; the last side to leave removes the file. The
    /// memory stays mapped as long as this, or a ring, call queue or doorbell object of it, exists.
    void leave();

    std::uint64_t generation() const { return mapping_->generation(); }
    Side side() const { return mapping_->side(); }
    const std::string& path() const { return mapping_->path(); }

    /// [any-thread] absent, alive or dead. Makes one system call: cheap enough for every 5 ms, not for every message.
    PeerState peer_state() const { return mapping_->peer_state(); }
    std::size_t arena_bytes(Side owner) const { return mapping_->arena(owner).size(); }
    std::uint32_t peer_pid() const; ///< As the peer wrote it, in its own pid namespace.
    /// [any-thread] Has the watcher look out for what happens to this generation. Throws Error.
    void watch(Watcher& watcher) const { watcher.watch_file(mapping_->fd()); }

    /// [any-thread] A newer generation exists, or the file was removed or truncated: leave and join again.
    /// Makes two system calls.
    bool superseded() const;
    bool truncated() const { return mapping_->truncated(); } ///< [any-thread]

    /// New objects of this side; the peer sees them after publish(). They throw Error if the arena or the
    /// directory is full, or the name (at most 103 characters, unique on this side) or an option is not
    /// acceptable.
    RingHandle add_ring(const std::string& name, const RingOptions& options);
    CallQueueHandle add_call_queue(const std::string& name, const CallQueueOptions& options);
    std::span<std::byte> add_blob(const std::string& name, std::size_t bytes); ///< zero-filled, 128-aligned

    /// Makes all objects added so far visible and tells the peer. May be called again after further
    /// additions.
    void publish();
    bool peer_published() const;

    /// Objects of either side by name; empty if there is none (yet). They throw Error if the peer has damaged
    /// it.
    std::optional<RingHandle> find_ring(Side owner, const std::string& name) const;
    std::optional<CallQueueHandle> find_call_queue(Side owner, const std::string& name) const;
    std::optional<std::span<std::byte>> find_blob(Side owner, const std::string& name) const;
    /// A copy that the peer cannot change while it is parsed.
    std::optional<std::vector<std::byte>> copy_blob(Side owner, const std::string& name) const;
    std::vector<ObjectInfo> list(Side owner) const;

    /// [any-thread] Ends all sleeps of this process in this segment, so that their waits look again: also those on words
    /// that nobody can wake any more, because the file was truncated.
    void end_sleeps() const;

    Doorbell& doorbell() { return doorbell_; }
    Doorbell& peer_doorbell() { return peer_doorbell_; }
    bool ring_peer(unsigned bit) { return peer_doorbell_.ring(bit); } ///< true: it was asleep

  private:
    friend class SegmentJoiner;
    Segment(std::shared_ptr<const Mapping> mapping, std::unique_ptr<CloseOnForkDescriptor> life_lock);

    std::shared_ptr<const Mapping> mapping_;
    Directory directory_;
    Doorbell doorbell_, peer_doorbell_;
    std::unique_ptr<CloseOnForkDescriptor> life_lock_; ///< holds the lock of this side
    std::atomic<bool> left_{false};
};

} // namespace tandem::shm
