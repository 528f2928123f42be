// SPDX-License-Identifier: Apache-2.0
// The shared memory of a link for the cases: sides A and B join one segment, each adds its objects and finds
// the peer's.
#pragma once
#include "apps/bench/measurements/measurements.hpp"
#include "shm/segment.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace tandem::bench {

/// Returns the link option `wait` for a case's wake mode. Two sides on one core must yield instead of
/// spinning.
inline shm::WaitOptions wait_options(const Case& bench_case,
                                     std::chrono::nanoseconds spin = shm::WaitOptions{}.spin) {
    shm::WaitOptions options;
    options.spin = spin;
    if (bench_case.wake == Wake::spin)
        options.mode = shm::WaitMode::spin;
    else if (bench_case.wake == Wake::blocking)
        options.mode = shm::WaitMode::futex;
    else if (bench_case.placement == Placement::same_core)
        options.mode = shm::WaitMode::same_core;
    else
        options.mode = shm::WaitMode::spin_then_futex;
    return options;
}

/// [one thread] One side of a link. Rings have the options that the proxy gives to data ports.
class BenchLink {
  public:
    static constexpr std::size_t default_capacity = std::size_t{64} * 1024;
    static constexpr std::uint32_t chunks = 4; ///< the reader holds one, the writer fills one, two wait

    /// Joins the case's segment; A is the first side. A second link of a case needs another name. Throws
    /// shm::Error.
    BenchLink(Session& session, std::size_t arena_bytes, const std::string& suffix = "")
        : side_(session.is_side_a() ? shm::Side::first : shm::Side::second) {
        shm::JoinOptions options;
        options.arena_bytes = arena_bytes;
        segment_ = shm::Segment::join(session.name() + suffix, side_, options);
    }

    shm::Segment& segment() { return *segment_; }
    shm::Side side() const { return side_; }

    /// Returns a ring that this side writes, for messages of `bytes`; long messages get separate chunks.
    shm::RingHandle add_ring(const std::string& name, std::size_t bytes,
                             std::size_t capacity = default_capacity) {
        shm::RingOptions options;
        options.writer = side_;
        options.capacity = capacity;
        if (bytes > max_bytes_in_ring) {
            options.max_record = 64;
            options.chunk_bytes = bytes;
            options.chunks = chunks;
        } else {
            options.max_record = bytes;
        }
        return segment_->add_ring(name, options);
    }
    /// Returns an upper bound of the arena bytes that such a ring needs, with its share of the directory.
    static std::size_t ring_bytes(std::size_t bytes, std::size_t capacity = default_capacity) {
        return std::size_t{256} * 1024 + 2 * capacity + (bytes > max_bytes_in_ring ? chunks + 1 : 4) * bytes;
    }

    /// Call it when all objects of this side are added: publishes them, and waits for the peer's.
    void publish_and_wait() {
        segment_->publish();
        while (!segment_->peer_published()) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    /// [after publish_and_wait()] Returns the peer's ring. Throws std::runtime_error if the peer has no such
    /// ring.
    shm::RingHandle peer_ring(const std::string& name) {
        const auto found = segment_->find_ring(shm::other(side_), name);
        if (!found) throw std::runtime_error("the other side has no ring " + name);
        return *found;
    }

  private:
    static constexpr std::size_t max_bytes_in_ring = 4096;

    shm::Side side_;
    std::unique_ptr<shm::Segment> segment_;
};

/// Writes one message of `bytes`, with `sequence` as its content and stamp, as the proxy writes a port's value: creates a
/// short one in scratch(), from where it is copied into the ring, and a long one in a chunk of the ring. Throws
/// std::runtime_error if the ring refuses it, which an intact ring never does.
inline void write_message(shm::RingWriter& ring, std::size_t bytes, std::uint64_t sequence) {
    bool written = false;
    if (bytes <= ring.max_record()) {
        fill_message(ring.scratch().data(), bytes, sequence);
        written = ring.publish(bytes, sequence);
    } else if (const std::span<std::byte> chunk = ring.reserve(bytes); chunk.data() != nullptr) {
        fill_message(chunk.data(), bytes, sequence);
        written = ring.commit(bytes, sequence);
    }
    if (!written) throw std::runtime_error("the ring refuses a message");
}

} // namespace tandem::bench
