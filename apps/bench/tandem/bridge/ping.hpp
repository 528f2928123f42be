// SPDX-License-Identifier: Apache-2.0
// What BenchPing (OPRoS) and BenchPong (RTM) share: eight doubles go to BenchPong and come back, by themselves or in a longer
// message (messages.hpp), each side polls its port or is woken, and the message carries the clock's readings at sending and
// receiving. Both processes read the same clock of the machine, so that each direction is measured on its own. In a paired case
// the same threads exchange the same messages over the floor (floor.hpp) as well, in alternation; only those that sleep over it
// are threads of their own.
#pragma once
#include "apps/bench/harness/tick_record.hpp"
#include "apps/bench/tandem/bridge/paired_window.hpp"
#include "apps/bench/tandem/bridge/samples.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace tandem::bench {

/// How long an event-driven sender waits, awake, so that its receiver has gone to sleep: the link polls for 50 us before.
inline void wait_until_receiver_sleeps() {
    for (const std::uint64_t end = ticks() + to_ticks(200e3); ticks() < end;) {
    }
}

/// After each message of a case of tails, one of which comes each millisecond: who polls without end under SCHED_FIFO is stopped by
/// the kernel for 50 ms of each second (sched_rt_runtime_us), which would count as the bridge's tail.
inline void leave_core() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

/// Of a case of tails, whose ticks come each millisecond.
constexpr std::int64_t tail_period_ns = 1'000'000;

/// [tick-thread] By how many ns this tick is late; 0 if it is an extra one.
inline double lateness_of_this_tick(TickLateness& lateness) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(
        std::max<std::int64_t>(0, lateness.of_tick(now.tv_sec * 1'000'000'000 + now.tv_nsec)));
}

/// [one thread at a time] BenchPong's side. Port: bool receive(PingMessage&, std::uint64_t& at), which says
/// when, and void send(const PingMessage&, std::size_t sent_at), which puts the time into that element.
class PingServer {
  public:
    /// The case is paired.
    void pair(const std::string& floor_file) {
        floor_ = std::make_unique<Floor>(floor_file, Floor::Role::answers);
        polled_floor_ = std::make_unique<PolledFloor>(*floor_);
    }
    /// Of a case of tails: its messages say how late they are sent.
    void tell_lateness(std::int64_t origin_ns) { lateness_.emplace(tail_period_ns, origin_ns); }

    /// BenchPong's onExecute().
    template <class Port>
    void answer_for_a_slice(Port& port) {
        if (sends_in_each_tick_) return on_road(port, [this](auto& road) { this->send_again(road); });
        std::uint64_t end = ticks() + to_ticks(slice_ns);
        for (std::uint64_t now = ticks(); now < end && !sends_in_each_tick_; now = ticks())
            on_road(port, [&](auto& road) { answer_if_any(road, now, end); });
    }
    /// Of a BenchPong that a listener wakes: answers the ping that has come.
    template <class Port>
    void answer(Port& port, PingMessage message, std::uint64_t received_at) {
        message[2] = as_double(received_at);
        if (floor_) floor_->note_switches_of_half();
        wait_until_receiver_sleeps();
        port.send(message, pong_sent_at);
    }
    /// The thread that sleeps over the floor, until nothing more is measured.
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

/// [one thread at a time] BenchPing's measurement: it sends pings until the link is up, warms up, and measures one direction. Cold,
/// the sender of that direction sends one message in each of its ticks, as components do, and the receiver polls meanwhile.
class PingClient {
  public:
    PingClient(Samples samples, bool measures_ping, bool cold)
        : samples_(std::move(samples)), measures_ping_(measures_ping), cold_(cold) {}

    /// The case is paired: its samples are the ratios of windows, of so many messages each way.
    void pair(const std::string& floor_file, std::size_t messages) {
        window_ = std::make_unique<PairedWindow>(floor_file, messages);
        polled_floor_ = std::make_unique<PolledFloor>(window_->floor());
        sleeping_floor_ = std::make_unique<FloorPort<Wake::blocking>>(window_->floor());
    }

    /// The paired case is one of tails: its samples are times from when the sender's tick was due, through the bridge to the
    /// receiver, and those over the floor, which are an empty loop's on both cores, with a minus in front.
    void measure_tails(std::int64_t origin_ns) { lateness_.emplace(tail_period_ns, origin_ns); }

    /// BenchPing's onExecute().
    template <class Port>
    void ping_for_a_slice(Port& port) {
        const std::uint64_t end = ticks() + to_ticks(cold_ && !measures_ping_ ? 10 * slice_ns : slice_ns);
        // No answer within the slice: the next one sends a new ping. Cold, the next tick does in any case.
        while (!samples_.done() && ticks() < end && ping_on_road(port, end) && !(cold_ && measures_ping_)) {
        }
    }

    /// Of a BenchPing that is woken by what comes: the first ping, in onStart(), and the next one after each answer.
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
    /// The thread that sleeps over the floor, until nothing more is measured. Never two messages are under way: this thread and
    /// the one that the bridge wakes take turns.
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
            window_->add(ns); // for the change of roads
        } else if (const auto ratio = window_->add(ns))
            samples_.add(*ratio, now);
        if (samples_.done()) window_->floor().end();
    }

    Samples samples_;
    bool measures_ping_; // otherwise the way back
    bool cold_, answered_ = false;
    std::uint64_t sequence_ = 0;
    std::optional<TickLateness> lateness_;
    std::unique_ptr<PairedWindow> window_; // of a paired case
    std::unique_ptr<PolledFloor> polled_floor_;
    std::unique_ptr<FloorPort<Wake::blocking>> sleeping_floor_;
};

} // namespace tandem::bench
