// SPDX-License-Identifier: Apache-2.0
// How two processes that know only the link's name end up in the same generation, whoever comes first, dies
// or comes back, and however many come at once.
//
// Decisions about one file (join it, leave it, remove it) are made under its hand-over byte. What is left is
// the race between two files: A creates generation 2 because it saw its dead self in 1, while B leaves 1,
// which removes it, sees an empty directory, and creates 1 again. So whoever has created one looks again:
//
//     A: name 2 | list                B: name 1 | list
//
// One of the two lists is later than both names. Its owner sees both files: if the other is newer, it gives
// up its own; if the other is older, it marks that one superseded, and its holder leaves and joins again.
#include "shm/os/clock.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/segment.hpp"
#include "shm/segment/liveness.hpp"

namespace tandem::shm {

class Joining {
  public:
    Joining(const std::string& link, Side side, const JoinOptions& options)
        : link_(link), side_(side), options_(options), access_(access_of_this_process(options.group)) {}

    /// One try. Empty: somebody else changed the scene meanwhile.
    std::unique_ptr<Segment> attempt() {
        std::uint64_t newest = 0, living = 0;
        for (const auto generation : list_generations(link_)) {
            newest = std::max(newest, generation);
            const std::string path = segment_path(link_, generation);
            const Probe probe = probe_segment(path);
            if (!probe.exists || (probe.dead() && remove_if_dead(path))) continue;
            if (probe.held[index_of(side_)]) throw side_taken(path);
            living = std::max(living, generation);
        }
        const auto pages = [](std::uint64_t bytes) { return round_up(bytes, layout::page); };
        arena_bytes_[0] = arena_bytes_[1] = pages(std::max<std::uint64_t>(options_.arena_bytes, 1));
        at_once_ = layout::arenas_begin + arena_bytes_[0] + arena_bytes_[1];
        arena_bytes_[index_of(side_)] += pages(options_.loan_bytes);
        arena_bytes_[index_of(other(side_))] += pages(options_.peer_loan_bytes);
        if (living != 0) {
            bool usable = true;
            auto joined = attach(segment_path(link_, living), usable);
            if (joined || usable) return joined;
        }
        return create(newest + 1);
    }

  private:
    SideTaken side_taken(const std::string& path) const {
        return SideTaken(path + ": side " + name_of(side_) +
                         " is held by a living process; stop it or choose another link name");
    }

    std::shared_ptr<const Mapping> map(FileDescriptor file, const std::string& path,
                                       const layout::SegmentHeader& header) const {
        return std::make_shared<const Mapping>(std::move(file), path, header, side_, options_.late_after);
    }

    /// I live here now: from the lock on the peer may see me, from `taken` on it must.
    std::unique_ptr<Segment> take_side(std::shared_ptr<const Mapping> mapping) const {
        auto& mine = mapping->half(side_);
        if (!try_lock(mapping->fd(), life_of(side_))) throw side_taken(mapping->path());
        mine.pid.store(static_cast<std::uint32_t>(getpid()), std::memory_order_relaxed);
        mine.joined_ns.store(now_ns(), std::memory_order_relaxed);
        mine.heartbeat_ns.store(now_ns(), std::memory_order_relaxed);
        mine.taken.store(1, std::memory_order_release);
        return std::unique_ptr<Segment>(new Segment(std::move(mapping)));
    }

    /// `usable` false: a newer generation is needed. Empty though usable: the file died under our hands.
    std::unique_ptr<Segment> attach(const std::string& path, bool& usable) {
        FileDescriptor file = open_segment(path, access_);
        if (!file) return nullptr;
        const auto header = read_header(file.get(), path, options_.contract);
        const auto mapping = map(std::move(file), path, header);
        const int fd = mapping->fd();
        const HandOver hand_over(fd);
        usable = hand_over.held(); // if not, its holder was stopped in the middle: do not wait for it
        if (!usable || !still_named(fd)) return nullptr;
        if (held_by_other(fd, life_of(side_))) throw side_taken(path);
        if (!held_by_other(fd, life_of(other(side_)))) { // nobody lives here any more
            usable = ::unlink(path.c_str()) == 0;
            return nullptr;
        }
        const bool large_enough = header.arena_bytes[index_of(side_)] >= arena_bytes_[index_of(side_)];
        usable = large_enough && mapping->half(side_).taken.load(std::memory_order_acquire) == 0;
        for (const Side half : {Side::first, Side::second})
            arena_bytes_[index_of(half)] =
                std::max(arena_bytes_[index_of(half)], header.arena_bytes[index_of(half)]);
        if (!usable) return nullptr;
        auto joined = take_side(mapping);
        joined->ring_peer(Doorbell::attention_bit);
        return joined;
    }

    layout::SegmentHeader new_header(std::uint64_t generation) const {
        layout::SegmentHeader header{};
        header.magic = layout::magic;
        header.layout_version = layout::layout_version;
        header.header_bytes = sizeof header;
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
                                           ? create_sparse(path, header.total_bytes, at_once_, access_)
                                           : create_unnamed(path, header.total_bytes, access_);
        if (pwrite(unnamed.get(), static_cast<const void*>(&header), sizeof header, 0) != sizeof header)
            throw Error(path + ": cannot be written (" + errno_text() + ")");
        auto created = name_and_take(unnamed.get(), path, header);
        return created && settle(generation) ? std::move(created) : nullptr;
    }

    /// The file is opened again by its name, because closing that descriptor (our death included) is then
    /// reported to watchers under that name. The hand-over byte keeps others off until the new descriptor has
    /// our lock.
    std::unique_ptr<Segment> name_and_take(int unnamed, const std::string& path,
                                           const layout::SegmentHeader& header) const {
        const HandOver hand_over(unnamed);
        if (!give_name(unnamed, path)) return nullptr;
        try {
            FileDescriptor file = open_segment(path, access_);
            return file ? take_side(map(std::move(file), path, header)) : nullptr;
        } catch (const std::exception&) {
            ::unlink(path.c_str()); // nothing stays behind; the reason goes on to the caller
            throw;
        }
    }

    /// Looks for other generations that appeared meanwhile. False: a newer one lives, ours must go.
    bool settle(std::uint64_t mine) const {
        for (const auto generation : list_generations(link_)) {
            const std::string path = segment_path(link_, generation);
            if (generation == mine || probe_segment(path).dead()) continue;
            if (generation > mine) return false;
            const FileDescriptor older = open_segment(path, access_);
            const auto at = static_cast<off_t>(offsetof(layout::SegmentHeader, superseded_by));
            if (older && pwrite(older.get(), &mine, sizeof mine, at) != sizeof mine)
                throw Error(path + ": cannot be marked superseded (" + errno_text() + "); remove it");
        }
        return true;
    }

    std::string link_;
    Side side_;
    JoinOptions options_;
    Access access_;
    std::uint64_t arena_bytes_[2] = {}; // of each half
    std::uint64_t at_once_ = 0;         // bytes that must be there, though not all of them are reserved
};

std::unique_ptr<Segment> Segment::join(const std::string& link, Side side, const JoinOptions& options) {
    check_link_name(link);
    Joining joining(link, side, options);
    constexpr int attempts = 100;
    for (int i = 0; i < attempts; ++i)
        if (auto joined = joining.attempt()) return joined;
    throw Error(segment_path(link, 0) +
                ": generations come and go too fast to join one; stop what restarts in a loop");
}

} // namespace tandem::shm
