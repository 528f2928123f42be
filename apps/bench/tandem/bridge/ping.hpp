// SPDX-License-Identifier: Apache-2.0
// The common parts of BenchPing (OPRoS) and BenchPong (RTM). Eight doubles go to BenchPong and come back,
// alone or in a longer message (messages.hpp). Each side polls its port or is woken. The message carries the
// clock's readings at sending and receiving. Both processes read the same clock of the machine, so each
// direction is measured separately. In a paired case the same threads also exchange the same messages over
// the floor (floor.hpp), in alternation; only the threads that sleep over the floor are additional ones.
#pragma once
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/tandem/bridge/paired_window.hpp"
#include "apps/bench/tandem/bridge/samples.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace tandem::bench {

/// How long an event-driven sender waits, awake, so that its receiver has gone to sleep: before that, the
/// link polls for 50 us.
inline void wait_until_receiver_sleeps() {
    for (const std::uint64_t end = ticks() + to_ticks(200e3); ticks() < end;) {
    }
}

/// The pause after each message of a case of tails, which sends one message per millisecond. The kernel stops
/// a thread that polls without end under SCHED_FIFO for 50 ms of each second (sched_rt_runtime_us), which
/// would count as the bridge's tail.
inline void leave_core() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

/// The period of a case of tails.
constexpr std::int64_t tail_period_ns = 1'000'000;

/// [tick-thread] Returns the lateness of this tick in ns; 0 for an additional tick.
inline double lateness_of_this_tick(TickLateness& lateness) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(
        std::max<std::int64_t>(0, lateness.of_tick(now.tv_sec * 1'000'000'000 + now.tv_nsec)));
}

/// [one thread at a time] BenchPong's side. Port: bool receive(PingMessage&, std::uint64_t& at), where `at`
/// gets the time of receiving, and void send(const PingMessage&, std::size_t sent_at), which writes the time
/// of sending into that element.
class PingServer {
  public:
    /// Makes the case a paired one.
    void pair(const std::string& floor_file) {
        floor_ = std::make_unique<Floor>(floor_file, Floor::Role::answers);
        polled_floor_ = std::make_unique<PolledFloor>(*floor_);
    }
    /// Makes the case one of tails: its messages carry the lateness of their sending.
    void tell_lateness(std::int64_t origin_ns) { lateness_.emplace(tail_period_ns, origin_ns); }

    /// Called by BenchPong's onExecute().
    template <class Port>
    void answer_for_a_slice(Port& port) {
        if (sends_in_each_tick_) return on_road(port, [this](auto& road) { this->send_again(road); });
        std::uint64_t end = ticks() + to_ticks(slice_ns);
        for (std::uint64_t now = ticks(); now < end && !sends_in_each_tick_; now = ticks())
            on_road(port, [&](auto& road) { answer_if_any(road, now, end); });
    }
    /// For a BenchPong that a listener wakes: answers the ping that has arrived.
    template <class Port>
    void answer(Port& port, PingMessage message, std::uint64_t received_at) {
        message[2] = as_double(received_at);
        if (floor_) floor_->note_switches_of_half();
        wait_until_receiver_sleeps();
        port.send(message, pong_sent_at);
    }
    /// The thread that sleeps over the floor until the measurement ends.
    void answer_over_floor() {
        FloorPort<Wake::blocking> port(*floor_);
        for (PingMessage message;;) {
            port.wait(message);
            if (floor_->ended()) return port.send(message); // ends BenchPing's thread
            answer(port, message, ticks());
        }
    }

  private:
    template <class Port, class Use>
    void on_road(Port& port, Use use) {
        if (floor_ && floor_->in_use())
            polled_floor_->on_port(use);
        else
            use(port);
    }
    template <class Port>
    void answer_if_any(Port& port, std::uint64_t now, std::uint64_t& end) {
        std::uint64_t received_at = 0;
        if (!port.receive(message_, received_at)) return;
        message_[2] = as_double(received_at);
        // Bounded: the peer is not trusted.
        end = std::max(end, now + to_ticks(std::clamp(message_[5], 0.0, 500.0) * 1e6));
        sends_in_each_tick_ = message_[4] != 0;
        if (sends_in_each_tick_) return;
        send_again(port);
        if (lateness_) leave_core();
    }
    template <class Port>
    void send_again(Port& port) {
        if (lateness_ && sends_in_each_tick_) message_[6] = lateness_of_this_tick(*lateness_);
        port.send(message_, pong_sent_at);
    }

    std::unique_ptr<Floor> floor_; // of a paired case
    std::unique_ptr<PolledFloor> polled_floor_;
    PingMessage message_{};
    bool sends_in_each_tick_ = false;
    std::optional<TickLateness> lateness_;
};

/// [one thread at a time] BenchPing's side, which measures: it sends pings until the link is up, warms up,
/// and measures one direction. In cold cases, the sender of that direction sends one message in each of its
/// ticks, as components do, and the receiver polls.
class PingClient {
  public:
    PingClient(Samples samples, bool measures_ping, bool cold)
        : samples_(std::move(samples)), measures_ping_(measures_ping), cold_(cold) {}

    /// Makes the case a paired one: its samples are ratios of windows of `messages` messages each way.
    void pair(const std::string& floor_file, std::size_t messages) {
        window_ = std::make_unique<PairedWindow>(floor_file, messages);
        polled_floor_ = std::make_unique<PolledFloor>(window_->floor());
        sleeping_floor_ = std::make_unique<FloorPort<Wake::blocking>>(window_->floor());
    }

    /// Makes the paired case one of tails. Its samples are times from when the sender's tick was due until
    /// the receiver has the message. Times over the floor, where both cores run an empty loop, have a minus
    /// sign.
    void measure_tails(std::int64_t origin_ns) { lateness_.emplace(tail_period_ns, origin_ns); }

    /// Called by BenchPing's onExecute().
    template <class Port>
    void ping_for_a_slice(Port& port) {
        const std::uint64_t end = ticks() + to_ticks(cold_ && !measures_ping_ ? 10 * slice_ns : slice_ns);
        // If no answer arrives in this slice, the next slice sends a new ping. In cold cases, the next tick always does.
        while (!samples_.done() && ticks() < end && ping_on_road(port, end) && !(cold_ && measures_ping_)) {
        }
    }

    /// For a BenchPing that messages wake: sends the first ping in onStart(), and the next one after each
    /// answer.
    template <class Port>
    void send_ping(Port& port) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        wait_until_receiver_sleeps();
        if (on_floor())
            sleeping_floor_->send(message, ping_sent_at);
        else
            port.send(message, ping_sent_at);
    }
    template <class Port>
    void take_answers(Port& port) {
        PingMessage reply;
        std::uint64_t at = 0;
        while (port.receive(reply, at)) take_answer(port, reply, at);
    }
    /// The thread that sleeps over the floor until the measurement ends. At most one message is under way:
    /// this thread and the one that the bridge wakes take turns.
    template <class Port>
    void take_answers_over_floor(Port& port) {
        for (PingMessage reply;;) {
            sleeping_floor_->wait(reply);
            const std::uint64_t at = ticks();
            if (samples_.done()) return;
            take_answer(port, reply, at);
        }
    }

  private:
    bool on_floor() const { return window_ && window_->on_floor(); }

    template <class Port>
    bool ping_on_road(Port& port, std::uint64_t end) {
        if (!on_floor()) return ping(port, end);
        return polled_floor_->on_port([&](auto& floor) { return ping(floor, end); });
    }
    template <class Port>
    bool ping(Port& port, std::uint64_t end) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        if (cold_) message[5] = 500; // its slices must not end between two messages
        message[4] = cold_ && !measures_ping_;
        if (lateness_) message[6] = lateness_of_this_tick(*lateness_);
        if (message[4] == 0 || !answered_) port.send(message, ping_sent_at);
        PingMessage reply;
        std::uint64_t at = 0;
        do {
            while (!port.receive(reply, at))
                if (ticks() >= end) return false;
        } while (message[4] == 0 && reply[0] != message[0]); // the answer to a ping of an earlier slice
        add(reply, at);
        if (lateness_ && !measures_ping_) leave_core();
        return !samples_.done();
    }
    template <class Port>
    void take_answer(Port& port, const PingMessage& reply, std::uint64_t now) {
        if (reply[0] != static_cast<double>(sequence_)) return;
        if (window_) window_->floor().note_switches_of_half();
        add(reply, now);
        if (!samples_.done()) return send_ping(port);
        if (window_) sleeping_floor_->send(reply); // ends BenchPong's thread
    }
    void add(const PingMessage& reply, std::uint64_t now) {
        answered_ = true;
        const double ns =
            to_ns(measures_ping_ ? as_bits(reply[2]) - as_bits(reply[1]) : now - as_bits(reply[3]));
        if (!window_) return samples_.add(ns, now);
        if (lateness_) {
            if (!window_->begins_half()) samples_.add(on_floor() ? -(reply[6] + ns) : reply[6] + ns, now);
            window_->add(ns); // for the change of paths
        } else if (const auto ratio = window_->add(ns))
            samples_.add(*ratio, now);
        if (samples_.done()) window_->floor().end();
    }

    Samples samples_;
    bool measures_ping_; // otherwise the reply
    bool cold_, answered_ = false;
    std::uint64_t sequence_ = 0;
    std::optional<TickLateness> lateness_;
    std::unique_ptr<PairedWindow> window_; // of a paired case
    std::unique_ptr<PolledFloor> polled_floor_;
    std::unique_ptr<FloorPort<Wake::blocking>> sleeping_floor_;
};

} // namespace tandem::bench
