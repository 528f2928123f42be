// SPDX-License-Identifier: Apache-2.0
// What BenchPing (OPRoS) and BenchPong (RTM) share: eight doubles go to BenchPong and come back, by themselves or in a longer
// message (messages.hpp), each side polls its port or is woken, and the message carries the clock's readings at sending and
// receiving. Both processes read the same clock of the machine, so that each direction is measured on its own.
#pragma once
#include "apps/bench/tandem/bridge/samples.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace tandem::bench {

/// [0] the sequence number; [1] BenchPing's clock at sending, [2] BenchPong's at receiving, [3] BenchPong's at
/// sending, each as the bits of a tick count; [4] not 0: from now on BenchPong sends once in each of its ticks; [5]
/// milliseconds that it polls from then on before it gives its thread back; the rest is payload.
using PingMessage = std::array<double, 8>;

inline double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
inline std::uint64_t as_bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// How long one onExecute() polls: the host gets its thread back in between, and can stop the component.
constexpr double slice_ns = 20e6;

/// How long an event-driven sender waits, awake, so that its receiver has gone to sleep: the link polls for 50 us before.
inline void wait_until_receiver_sleeps() {
    for (const std::uint64_t end = ticks() + to_ticks(200e3); ticks() < end;) {
    }
}

/// [one thread] BenchPong's side. Port: bool receive(PingMessage&), void send(const PingMessage&).
class PingServer {
  public:
    /// BenchPong's onExecute().
    template <class Port>
    void answer_for_a_slice(Port& port) {
        if (sends_in_each_tick_) return send_again(port);
        std::uint64_t end = ticks() + to_ticks(slice_ns);
        for (std::uint64_t now = ticks(); now < end; now = ticks()) {
            if (!port.receive(message_)) continue;
            message_[2] = as_double(ticks());
            // Bounded: the peer is not trusted.
            end = std::max(end, now + to_ticks(std::clamp(message_[5], 0.0, 500.0) * 1e6));
            sends_in_each_tick_ = message_[4] != 0;
            if (sends_in_each_tick_) return;
            message_[3] = as_double(ticks());
            port.send(message_);
        }
    }
    /// Of a BenchPong that a listener wakes: answers the ping that has come.
    template <class Port>
    void answer(Port& port, PingMessage message) {
        message[2] = as_double(ticks());
        wait_until_receiver_sleeps();
        message[3] = as_double(ticks());
        port.send(message);
    }

  private:
    template <class Port>
    void send_again(Port& port) {
        message_[3] = as_double(ticks());
        port.send(message_);
    }

    PingMessage message_{};
    bool sends_in_each_tick_ = false;
};

/// [one thread] BenchPing's measurement: it sends pings until the link is up, warms up, and measures one direction. Cold,
/// the sender of that direction sends one message in each of its ticks, as components do, and the receiver polls meanwhile.
class PingClient {
  public:
    PingClient(Samples samples, bool measures_ping, bool cold)
        : samples_(std::move(samples)), measures_ping_(measures_ping), cold_(cold) {}

    /// BenchPing's onExecute().
    template <class Port>
    void ping_for_a_slice(Port& port) {
        const std::uint64_t end = ticks() + to_ticks(cold_ && !measures_ping_ ? 10 * slice_ns : slice_ns);
        // No answer within the slice: the next one sends a new ping. Cold, the next tick does in any case.
        while (!samples_.done() && ticks() < end && ping(port, end) && !(cold_ && measures_ping_)) {
        }
    }

    /// Of a BenchPing that is woken by what comes: the first ping, in onStart(), and the next one after each answer.
    template <class Port>
    void send_ping(Port& port) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        wait_until_receiver_sleeps();
        message[1] = as_double(ticks());
        port.send(message);
    }
    template <class Port>
    void take_answers(Port& port) {
        PingMessage reply;
        while (port.receive(reply)) {
            const std::uint64_t now = ticks();
            if (reply[0] != static_cast<double>(sequence_)) continue;
            add(reply, now);
            if (!samples_.done()) send_ping(port);
        }
    }

  private:
    template <class Port>
    bool ping(Port& port, std::uint64_t end) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        if (cold_) message[5] = 500; // its slices must not end between two messages
        message[4] = cold_ && !measures_ping_;
        message[1] = as_double(ticks());
        if (message[4] == 0 || samples_.empty()) port.send(message);
        PingMessage reply;
        do {
            while (!port.receive(reply))
                if (ticks() >= end) return false;
        } while (message[4] == 0 && reply[0] != message[0]); // the answer to a ping of an earlier slice
        add(reply, ticks());
        return !samples_.done();
    }
    void add(const PingMessage& reply, std::uint64_t now) {
        samples_.add(to_ns(measures_ping_ ? as_bits(reply[2]) - as_bits(reply[1]) : now - as_bits(reply[3])),
                     now);
    }

    Samples samples_;
    bool measures_ping_; // otherwise the way back
    bool cold_;
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::bench
