// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/os/error.hpp"
#include "shm/ring/ring.hpp"
#include "shm/segment/directory.hpp"
#include "shm/segment/segment_file.hpp"
#include "shm/wait/doorbell.hpp"

namespace tandem::shm {

struct JoinOptions {
    std::size_t arena_bytes = std::size_t{4}
                              << 20; ///< wanted at least for my half (and for the peer's, if I create)
    std::size_t loan_bytes = 0;      ///< wanted beside it in my half, for the chunks of rings
    std::size_t peer_loan_bytes = 0; ///< the same in the peer's half, if I create
    /// If I create: nothing of the arenas is reserved in advance (only that there are arena_bytes for each is
    /// checked), but every object when it is added, and of chunks what is used, when it is first used.
    bool sparse = false;
    std::uint64_t contract = 0; ///< the caller's own version; a segment of another is refused
    std::string group;          ///< if named: mode 0660, owned by that group
    std::chrono::nanoseconds late_after =
        std::chrono::milliseconds(100); ///< age of heartbeat that makes a peer late
};

/// One generation of a link, seen from one side. Join, add objects to my half, publish(); when the peer has
/// published, find its objects. Set-up calls: one thread at a time; the objects found have their own rules.
class Segment {
  public:
    /// Attaches to the newest generation in which the peer lives and my side was never taken, otherwise
    /// creates the next one; removes those whose holders are all dead. Never waits for the peer. Throws
    /// SideTaken if my side is held by somebody alive, Error for anything else that is in the way.
    static std::unique_ptr<Segment> join(const std::string& link, Side side, const JoinOptions& options = {});

    ~Segment(); ///< leave()
    Segment(const Segment&) = delete;
    Segment& operator=(const Segment&) = delete;

    /// [any-thread] Gives my side back and tells the peer; the last one to leave removes the file. The memory
    /// stays mapped as long as this, or a ring, call queue or doorbell object of it, exists.
    void leave();

    std::uint64_t generation() const { return mapping_->generation(); }
    Side side() const { return mapping_->side(); }
    const std::string& path() const { return mapping_->path(); }

    /// [any-thread] One system call: cheap enough for every 5 ms, not for every message.
    PeerState peer() const { return mapping_->peer(); }
    std::size_t arena_bytes(Side half) const { return mapping_->arena(half).size(); }
    std::uint32_t peer_pid() const; ///< As the peer wrote it: for messages to people only.
    void heartbeat();               ///< [any-thread] I am well. Call it more often than late_after.

    /// [any-thread] A newer generation exists, or the file was removed or cut: leave and join again. Two
    /// system calls.
    bool superseded() const;
    bool truncated() const { return mapping_->truncated(); } ///< [any-thread] The file was cut.

    /// New objects in my half; the peer sees them after publish(). Throw Error if the arena or the directory
    /// is full, or the name (at most 103 characters, unique in my half) or an option is not acceptable.
    RingHandle add_ring(const std::string& name, const RingOptions& options);
    CallQueueHandle add_call_queue(const std::string& name, const CallQueueOptions& options);
    std::span<std::byte> add_blob(const std::string& name, std::size_t bytes); ///< zero-filled, 128-aligned

    /// Makes everything added so far visible and rings the peer. May be called again after further additions.
    void publish();
    bool peer_published() const;

    /// Objects of either half by name; empty if there is none (yet). Throw Error if what stands there is not
    /// sound.
    std::optional<RingHandle> find_ring(Side half, const std::string& name) const;
    std::optional<CallQueueHandle> find_call_queue(Side half, const std::string& name) const;
    std::optional<std::span<std::byte>> find_blob(Side half, const std::string& name) const;
    std::optional<std::vector<std::byte>> copy_blob(Side half,
                                                    const std::string& name) const; ///< safe to parse
    std::vector<ObjectInfo> list(Side half) const;

    Doorbell& doorbell() { return mine_; }
    Doorbell& peer_doorbell() { return theirs_; }
    void ring_peer(unsigned bit) { theirs_.ring(bit); }

  private:
    friend class Joining;
    explicit Segment(std::shared_ptr<const Mapping> mapping);

    std::shared_ptr<const Mapping> mapping_;
    Directory directory_;
    Doorbell mine_, theirs_;
    pid_t joined_by_;
    std::atomic<bool> left_{false};
};

} // namespace tandem::shm
