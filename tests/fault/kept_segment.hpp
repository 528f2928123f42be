// SPDX-License-Identifier: Apache-2.0
// A segment that is still read after its file was removed: what its rings have counted, and which messages nobody took.
#pragma once
#include "shm/inspect/observer.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/ring/ring_view.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace tandem::shm::test {

class KeptSegment {
  public:
    /// The newest generation of the link.
    explicit KeptSegment(const std::string& link) {
        auto found = observe(link);
        if (!found || found->segment.readability != Readability::readable) return;
        file_.emplace(found->segment.path);
        if (*file_) observation_ = std::move(found);
    }
    explicit operator bool() const { return observation_.has_value(); }
    std::uint64_t generation() const { return observation_->segment.generation; }

    struct Ring {
        std::string name;
        Side writer;
        RingCounters counters;
        std::uint64_t
            untaken; ///< messages that lie in the ring, within its depth: the others count as skipped
    };
    std::vector<Ring> rings() {
        observation_->rings.clear();
        observation_->call_queues.clear();
        observation_->blobs.clear();
        observe_objects(*file_, *observation_);
        std::vector<Ring> found;
        for (const auto& ring : observation_->rings)
            found.push_back({ring.name, ring.writer, ring.counters, count_untaken(ring)});
        return found;
    }

  private:
    template <class T>
    T read(std::uint64_t offset) const {
        T value{};
        if (!file_->read(offset, {reinterpret_cast<std::byte*>(&value), sizeof value}))
            throw std::runtime_error("the segment's file is too short");
        return value;
    }

    /// Where the ring begins in the file.
    std::uint64_t find(const ObservedRing& ring) const {
        const auto& segment = observation_->segment;
        const std::uint64_t directory = sizeof(layout::SegmentHeader) +
                                        index_of(ring.owner) * sizeof(layout::SideHeader) +
                                        offsetof(layout::SideHeader, directory);
        for (std::size_t i = 0; i < layout::max_objects; ++i) {
            const auto entry = read<layout::DirectoryEntry>(directory + i * sizeof(layout::DirectoryEntry));
            if (entry.name == ring.name) return segment.arena_offset[index_of(ring.owner)] + entry.offset;
        }
        throw std::runtime_error("the segment has no ring " + ring.name);
    }

    /// Goes from the tail to the first record that is not committed, by the commit words alone.
    std::uint64_t count_untaken(const ObservedRing& ring) const {
        const std::uint64_t base = find(ring);
        const auto tail = read<std::uint64_t>(base + offsetof(layout::RingHeader, tail));
        std::uint64_t count = 0;
        for (std::uint64_t position = tail; position < tail + ring.capacity;) {
            const std::uint64_t place = position % ring.capacity;
            const auto word =
                CommitWord::unpack(read<std::uint64_t>(base + sizeof(layout::RingHeader) + place));
            if (word.kind == layout::RecordKind::none) break;
            const bool padding = word.kind == layout::RecordKind::padding;
            if (!padding) ++count;
            position += padding ? ring.capacity - place : record_size(word.length);
        }
        const std::uint64_t depth = ring.counters.depth;
        return depth != 0 ? std::min(count, depth) : count;
    }

    std::optional<ReadOnlySnapshot> file_;
    std::optional<Observation> observation_;
};

} // namespace tandem::shm::test
