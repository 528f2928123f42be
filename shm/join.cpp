// SPDX-License-Identifier: Apache-2.0
// How two processes that know only the link's name reach the same generation, in any order of arrivals, deaths and
// returns, and with any number of processes at the same time.
//
// All decisions about one file (join it, leave it, remove it) are made under its hand-over byte. What remains is a race
// between two files: A creates generation 2, because it found its own dead side in generation 1. Meanwhile B leaves
// generation 1, which removes the file, finds an empty directory, and creates generation 1 again. Therefore a process that
// has created a file lists the directory again:
//
//     A: name 2 | list                B: name 1 | list
//
// At least one of the two lists comes after both names. Its process sees both files. If the other file is newer, the
// process gives up its own file. If the other file is older, the process marks it as superseded, and the process in the
// older file leaves and joins again.
//
// Any user may create files in /dev/shm. A file that does not count (Access::counts()) is treated as if it did not exist,
// except that its name cannot be used: next_generation() then chooses a later one at random. Both processes decide by the
// same owner and group, and the rules above need no consecutive generations, so they still meet in the newest one.
#include "shm/os/clock.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/segment.hpp"
#include "shm/segment/liveness.hpp"
#include "shm/segment/process_identity.hpp"

namespace tandem::shm {

class SegmentJoiner {
  public:
    SegmentJoiner(const std::string& link, Side side, const JoinOptions& options)
        : link_(link), side_(side), options_(options), access_(access_of_this_process(options.group)) {}

    /// Makes one attempt. Returns nullptr if another process changed the files meanwhile.
    std::unique_ptr<Segment> attempt() {
        std::uint64_t newest = 0, newest_living = 0;
        for (const auto generation : list_generations(link_)) {
            const std::string path = segment_path(link_, generation);
            const Probe probe = probe_segment(path, access_);
            if (probe.foreign) {
                ignored_ = path;
                continue;
            }
            newest = std::max(newest, generation);
            if (!probe.exists || (probe.dead() && remove_if_dead(path))) continue;
            if (probe.held[index_of(side_)]) throw side_taken(path);
            newest_living = std::max(newest_living, generation);
        }
        const auto pages = [](std::uint64_t bytes) { return round_up(bytes, layout::page); };
        arena_bytes_[0] = arena_bytes_[1] = pages(std::max<std::uint64_t>(options_.arena_bytes, 1));
        required_bytes_ = layout::arenas_begin + arena_bytes_[0] + arena_bytes_[1];
        arena_bytes_[index_of(side_)] += pages(options_.chunk_pool_bytes);
        arena_bytes_[index_of(other(side_))] += pages(options_.peer_chunk_pool_bytes);
        if (newest_living != 0) {
            bool usable = true;
            auto joined = attach(segment_path(link_, newest_living), usable);
            if (joined || usable) return joined;
        }
        return create(next_generation(link_, newest, access_));
    }

  private:
    SideTaken side_taken(const std::string& path) const {
        return SideTaken(path + ": side " + name_of(side_) +
                         " is held by a living process; stop it or choose another link name");
    }

    std::shared_ptr<const Mapping> map(FileDescriptor file, const std::string& path,
                                       const layout::SegmentHeader& header) const {
        return std::make_shared<const Mapping>(std::move(file), path, header, side_);
    }

    /// Takes this side. The peer may see this side as alive once the lock is held, and does so once `taken` is set.
    std::unique_ptr<Segment> take_side(const std::shared_ptr<const Mapping>& mapping) const {
        auto& own = mapping->side_header(side_);
        auto life_lock = lock_life(mapping->fd(), side_);
        if (!life_lock) throw side_taken(mapping->path());
        std::unique_ptr<Segment> joined(new Segment(mapping, std::move(life_lock)));
        joined->ignored_file_ = ignored_;
        const ProcessIdentity self = identify_this_process();
        own.pid.store(self.pid, std::memory_order_relaxed);
        own.pid_namespace.store(self.pid_namespace, std::memory_order_relaxed);
        own.time_namespace.store(self.time_namespace, std::memory_order_relaxed);
        own.start_ticks.store(self.start_ticks, std::memory_order_relaxed);
        own.joined_ns.store(now_ns(), std::memory_order_relaxed);
        own.taken.store(1, std::memory_order_release);
        return joined;
    }

    /// Joins an existing file. Returns nullptr with `usable` false if a newer generation is needed, and with `usable` true
    /// if the file was removed meanwhile.
    std::unique_ptr<Segment> attach(const std::string& path, bool& usable) {
        FileDescriptor file = open_segment(path, access_);
        if (!file) return nullptr;
        const auto header = read_header(file.get(), path, options_.contract);
        const auto mapping = map(std::move(file), path, header);
        const int fd = mapping->fd();
        const HandOverLock hand_over(fd);
        usable = hand_over.held(); // otherwise its holder was stopped in the middle: do not wait for it
        if (!usable || !still_named(fd)) return nullptr;
        if (side_lives(fd, side_)) throw side_taken(path);
        if (!side_lives(fd, other(side_))) { // no side lives here any more
            usable = ::unlink(path.c_str()) == 0;
            return nullptr;
        }
        const bool large_enough = header.arena_bytes[index_of(side_)] >= arena_bytes_[index_of(side_)];
        usable = large_enough && mapping->side_header(side_).taken.load(std::memory_order_acquire) == 0;
        for (const Side owner : {Side::first, Side::second})
            arena_bytes_[index_of(owner)] =
                std::max(arena_bytes_[index_of(owner)], header.arena_bytes[index_of(owner)]);
        if (!usable) return nullptr;
        auto joined = take_side(mapping);
        announce_change(fd);
        joined->ring_peer(Doorbell::attention_bit);
        return joined;
    }

    layout::SegmentHeader new_header(std::uint64_t generation) const {
        layout::SegmentHeader header{};
        header.magic = layout::magic;
        header.layout_version = layout::layout_version;
        header.header_bytes = sizeof header;
        header.line_bytes = layout::line;
        header.page_bytes = layout::page;
        header.contract = options_.contract;
        header.generation = generation;
        header.arena_offset[0] = layout::arenas_begin;
        header.arena_offset[1] = layout::arenas_begin + arena_bytes_[0];
        header.arena_bytes[0] = arena_bytes_[0];
        header.arena_bytes[1] = arena_bytes_[1];
        header.total_bytes = layout::arenas_begin + arena_bytes_[0] + arena_bytes_[1];
        header.created_ns = now_ns();
        return header;
    }

    std::unique_ptr<Segment> create(std::uint64_t generation) {
        const std::string path = segment_path(link_, generation);
        const auto header = new_header(generation);
        const FileDescriptor unnamed = options_.sparse
                                           ? create_sparse(path, header.total_bytes, required_bytes_, access_)
                                           : create_unnamed(path, header.total_bytes, access_);
        if (pwrite(unnamed.get(), static_cast<const void*>(&header), sizeof header, 0) != sizeof header)
            throw Error(path + ": cannot be written (" + errno_text() + ")");
        auto created = name_and_take(unnamed.get(), path, header);
        return created && settle(generation) ? std::move(created) : nullptr;
    }

    /// Names the file and opens it again by its name: only then, closing the descriptor (also by death) is reported to
    /// watchers of that name. The hand-over byte keeps others from joining or removing the file until the new descriptor
    /// holds this side's lock.
    std::unique_ptr<Segment> name_and_take(int unnamed, const std::string& path,
                                           const layout::SegmentHeader& header) const {
        const HandOverLock hand_over(unnamed);
        if (!link_unnamed(unnamed, path)) return nullptr;
        try {
            FileDescriptor file = open_segment(path, access_);
            return file ? take_side(map(std::move(file), path, header)) : nullptr;
        } catch (const std::exception&) {
            ::unlink(path.c_str()); // no file is left behind
            throw;
        }
    }

    /// Looks for other generations that appeared meanwhile. Returns false if a newer one is alive, so that the created one
    /// must go.
    bool settle(std::uint64_t created) const {
        for (const auto generation : list_generations(link_)) {
            const std::string path = segment_path(link_, generation);
            const Probe probe = probe_segment(path, access_);
            if (generation == created || probe.foreign || probe.dead()) continue;
            if (generation > created) return false;
            const FileDescriptor older = open_segment(path, access_);
            const auto at = static_cast<off_t>(offsetof(layout::SegmentHeader, superseded_by));
            if (older && pwrite(older.get(), &created, sizeof created, at) != sizeof created)
                throw Error(path + ": cannot be marked superseded (" + errno_text() + "); remove it");
        }
        return true;
    }

    std::string link_;
    Side side_;
    JoinOptions options_;
    Access access_;
    std::string ignored_;               // a file of another user under a name of this link
    std::uint64_t arena_bytes_[2] = {}; // of each side
    std::uint64_t required_bytes_ = 0;  // must be free in /dev/shm, though not all of them are reserved
};

std::unique_ptr<Segment> Segment::join(const std::string& link, Side side, const JoinOptions& options) {
    check_link_name(link);
    SegmentJoiner joining(link, side, options);
    constexpr int attempts = 100;
    for (int i = 0; i < attempts; ++i)
        if (auto joined = joining.attempt()) return joined;
    throw Error(segment_path(link, 0) +
                ": generations come and go too fast to join one; stop the process that restarts in a loop");
}

} // namespace tandem::shm
