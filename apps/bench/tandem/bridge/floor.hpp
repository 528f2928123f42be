// SPDX-License-Identifier: Apache-2.0
// The floor of the bridge's paired cases: two minimal rings between the components that the bridge joins, in
// a file that the bench creates and both components map. The measuring component selects the path for each
// half of a window, the bridge or the rings; the other component follows.
#pragma once
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/machine/core_switches.hpp"
#include "apps/bench/tandem/bridge/messages.hpp"

#include <algorithm>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <climits>
#include <cstring>
#include <sys/mman.h>
#include <utility>
#include <variant>
#include <vector>

namespace tandem::bench {

namespace ipc = boost::interprocess;

/// [any-thread] The shared memory; zero at first.
class Floor {
  public:
    enum class Role { measures, answers };
    using Ring = IndexRing<sizeof(PingMessage), 64, Wake::spin>; // asleep it has the same memory
    using PictureRing = IndexRing<image_bytes, 4, Wake::spin>;
    /// Size of the file of a floor whose rings hold pictures, or eight doubles.
    static constexpr std::size_t file_bytes(bool pictures) {
        const std::size_t ring = pictures ? PictureRing::memory_bytes : Ring::memory_bytes;
        return page + 2 * ((ring + page - 1) / page * page);
    }

    /// Throws interprocess_exception. `file` has file_bytes() of either kind.
    Floor(const std::string& file, Role role)
        : role_(role), region_(ipc::file_mapping(file.c_str(), ipc::read_write), ipc::read_write, 0, 0,
                               nullptr, MAP_POPULATE) {}

    bool holds_pictures() const { return region_.get_size() == file_bytes(true); }
    /// Returns the ring that this side writes, or the one that it reads.
    std::byte* ring(bool written) const {
        const bool first = written == (role_ == Role::measures);
        return static_cast<std::byte*>(region_.get_address()) + page +
               (first ? 0 : (region_.get_size() - page) / 2);
    }
    /// Adds how often this thread has lost its core since its last report.
    void note_switches() {
        const std::uint64_t now = thread_switches();
        shared().switches.fetch_add(now - std::exchange(noted_switches(), now), std::memory_order_acq_rel);
    }

    /// Does the same for threads that sleep for one path only and take turns. Switches before the half of the
    /// window in which the thread first reports do not count, for example a wake-up of the other path's
    /// thread on its core.
    void note_switches_of_half() {
        if (!forget_earlier_switches()) note_switches();
    }

    /// [measures] Changes to the other path.
    void change_road() { store_half(half() + 1); }
    /// [measures] Ends the measurement.
    void end() { store_half(no_half); }
    /// [measures] Adds the time of a message over the rings, in a window that counts.
    void add_time(double ns) {
        const std::uint64_t count = shared().times.load(std::memory_order_relaxed);
        if (count == max_times) return;
        shared().ns[count].store(ns, std::memory_order_relaxed);
        shared().times.store(count + 1, std::memory_order_release);
    }
    /// Returns these times; only the first 300 are kept.
    std::vector<double> times() const {
        const std::uint64_t count =
            std::min<std::uint64_t>(shared().times.load(std::memory_order_acquire), max_times);
        std::vector<double> all;
        for (std::uint64_t i = 0; i < count; ++i)
            all.push_back(shared().ns[i].load(std::memory_order_relaxed));
        return all;
    }
    /// [measures] Returns how often threads of both sides have lost their cores, as they have reported.
    std::uint64_t switches() const { return shared().switches.load(std::memory_order_acquire); }

    /// [answers] Returns whether the rings are in use. Call it for each message: when the path changes, it
    /// records this thread's switches.
    bool in_use() {
        thread_local std::uint32_t seen = 0;
        const std::uint32_t now = half();
        if (now != std::exchange(seen, now)) note_switches();
        return now % 2 != 0;
    }
    /// [answers] Does the same for a thread that polls only for the bridge. Call it for each message. It
    /// records the switches only now and then, because recording takes as long as a message.
    void note_switches_on_bridge() {
        thread_local std::uint32_t messages = 0;
        if (!forget_earlier_switches() && ++messages % 64 == 0) note_switches();
    }
    bool ended() const { return half() == no_half; }
    /// [answers] Sleeps while the bridge is in use.
    void sleep_beside_bridge() {
        for (std::uint32_t now = half(); now % 2 == 0 && now != no_half; now = half())
            syscall(SYS_futex, &shared().half, FUTEX_WAIT, now, nullptr, nullptr, 0);
    }

  private:
    static constexpr std::size_t page = 4096;
    static constexpr std::uint32_t no_half = 0xffff'fffe;
    static constexpr std::size_t max_times = 300;
    struct SharedState {
        alignas(128) std::atomic<std::uint32_t> half; // of a window, counted; the odd ones go over the rings
        alignas(128) std::atomic<std::uint64_t> switches;
        std::atomic<std::uint64_t> times;
        std::atomic<double> ns[max_times];
    };
    static_assert(sizeof(SharedState) <= page);
    std::uint32_t half() const { return shared().half.load(std::memory_order_acquire); }
    void store_half(std::uint32_t half) {
        shared().half.store(half, std::memory_order_release);
        syscall(SYS_futex, &shared().half, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
    }
    /// Returns true in the first call of each half, and then discards this thread's earlier switches.
    bool forget_earlier_switches() {
        thread_local std::uint32_t seen = 0;
        const std::uint32_t now = half();
        if (now == std::exchange(seen, now)) return false;
        noted_switches() = thread_switches();
        return true;
    }
    static std::uint64_t& noted_switches() {
        thread_local std::uint64_t noted = thread_switches(); // one floor in a process
        return noted;
    }
    SharedState& shared() const { return *static_cast<SharedState*>(region_.get_address()); }

    Role role_;
    ipc::mapped_region region_;
};

/// [one thread at a time] A pair of minimal rings as the Port that ping.hpp requires. Like the components'
/// own loops, it polls between two readings of the clock, so that the two paths are the only difference.
template <Wake wake>
class FloorPort {
  public:
    explicit FloorPort(const Floor& floor) : out_(floor.ring(true)), in_(floor.ring(false)) {}

    void send(const PingMessage& message) {
        std::memcpy(out_.claim(), message.data(), sizeof message);
        out_.publish();
    }
    /// Writes the time of sending into that element.
    void send(PingMessage message, std::size_t sent_at) {
        message[sent_at] = as_double(ticks());
        send(message);
    }
    bool receive(PingMessage& message) {
        if (!in_.has_slot()) return false;
        wait(message);
        return true;
    }
    bool receive(PingMessage& message, std::uint64_t& at) {
        const bool received = receive(message);
        if (received) at = ticks();
        return received;
    }
    /// Waits in the ring's wake mode, for as long as the case may take.
    void wait(PingMessage& message) {
        std::memcpy(message.data(), in_.wait_for_slot(), sizeof message);
        in_.release();
    }

  private:
    IndexRing<sizeof(PingMessage), 64, wake> out_, in_;
};

/// [one thread at a time] The Port for pictures. Each side has a separate picture: it is filled, copied into
/// the ring and out of it, and read, all within the measured time.
class PictureFloorPort {
  public:
    explicit PictureFloorPort(const Floor& floor)
        : out_(floor.ring(true)), in_(floor.ring(false)), sent_(image_words), received_(image_words) {}

    void send(PingMessage message, std::size_t sent_at) {
        message[sent_at] = as_double(ticks());
        fill_image(sent_.data(), message);
        std::memcpy(out_.claim(), sent_.data(), image_bytes);
        out_.publish();
    }
    bool receive(PingMessage& message, std::uint64_t& at) {
        if (!in_.has_slot()) return false;
        std::memcpy(received_.data(), in_.wait_for_slot(), image_bytes);
        in_.release();
        read_image(received_.data(), message);
        at = ticks();
        return true;
    }

  private:
    static constexpr std::size_t image_words = image_bytes / sizeof(std::uint64_t);
    Floor::PictureRing out_, in_;
    std::vector<std::uint64_t> sent_, received_;
};

/// [one thread at a time] Calls use(port) with the port for the floor's messages.
class PolledFloor {
  public:
    explicit PolledFloor(const Floor& floor) {
        if (floor.holds_pictures())
            port_.emplace<PictureFloorPort>(floor);
        else
            port_.emplace<FloorPort<Wake::spin>>(floor);
    }
    template <class Use>
    decltype(auto) on_port(Use&& use) {
        if (auto* doubles = std::get_if<FloorPort<Wake::spin>>(&port_)) return use(*doubles);
        return use(std::get<PictureFloorPort>(port_));
    }

  private:
    std::variant<std::monostate, FloorPort<Wake::spin>, PictureFloorPort> port_;
};

} // namespace tandem::bench
