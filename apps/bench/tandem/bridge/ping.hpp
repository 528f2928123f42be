// SPDX-License-Identifier: Apache-2.0
// What BenchPing (OPRoS) and BenchPong (RTM) share: eight doubles go to BenchPong and come back, each side polls
// its port, and the message carries the clock's readings at sending and receiving. Both processes read the same
// clock of the machine, so that each direction is measured on its own.
#pragma once
#include "apps/bench/machine/clock.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace tandem::bench {

/// [0] the sequence number; [1] BenchPing's clock at sending, [2] BenchPong's at receiving, [3] BenchPong's at
/// sending, each as the bits of a tick count; [4] not 0: from now on BenchPong sends once in each of its ticks; [5]
/// milliseconds that it polls from then on before it gives its thread back; the rest is payload.
using PingMessage = std::array<double, 8>;

inline double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
inline std::uint64_t as_bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// How long one onExecute() polls: the host gets its thread back in between, and can stop the component.
constexpr double slice_ns = 20e6;

/// [tick-thread] BenchPong's side. Port: bool receive(PingMessage&), void send(const PingMessage&).
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

  private:
    template <class Port>
    void send_again(Port& port) {
        message_[3] = as_double(ticks());
        port.send(message_);
    }

    PingMessage message_{};
    bool sends_in_each_tick_ = false;
};

/// [tick-thread] BenchPing's measurement: it sends pings until the link is up, warms up, measures, and writes
/// the samples of one direction as doubles, in ns, into a file. Cold, the sender of that direction sends one message in each
/// of its ticks, as components do, and the receiver polls meanwhile.
class PingClient {
  public:
    PingClient(std::string file, bool measures_ping, std::size_t samples, double seconds, bool cold)
        : file_(std::move(file)), measures_ping_(measures_ping), samples_(samples), seconds_(seconds),
          cold_(cold), warm_up_(cold ? 5 : 2000) {}

    /// BenchPing's onExecute().
    template <class Port>
    void ping_for_a_slice(Port& port) {
        const std::uint64_t end = ticks() + to_ticks(cold_ && !measures_ping_ ? 10 * slice_ns : slice_ns);
        // No answer within the slice: the next one sends a new ping. Cold, the next tick does in any case.
        while (!done_ && ticks() < end && ping(port, end) && !(cold_ && measures_ping_)) {
        }
        if (!done_ && times_.size() >= warm_up_ + samples_) write_samples();
    }

  private:
    template <class Port>
    bool ping(Port& port, std::uint64_t end) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        if (cold_) message[5] = 500; // its slices must not end between two messages
        message[4] = cold_ && !measures_ping_;
        message[1] = as_double(ticks());
        if (message[4] == 0 || times_.empty()) port.send(message);
        PingMessage reply;
        do {
            while (!port.receive(reply))
                if (ticks() >= end) return false;
        } while (message[4] == 0 && reply[0] != message[0]); // the answer to a ping of an earlier slice
        const std::uint64_t now = ticks();
        if (times_.empty()) deadline_ = now + to_ticks(seconds_ * 1e9);
        times_.push_back(
            to_ns(measures_ping_ ? as_bits(reply[2]) - as_bits(reply[1]) : now - as_bits(reply[3])));
        if (times_.size() >= warm_up_ + samples_ || (now >= deadline_ && times_.size() > warm_up_))
            write_samples();
        return !done_;
    }
    void write_samples() {
        done_ = true;
        std::ofstream(file_ + ".part", std::ios::binary)
            .write(reinterpret_cast<const char*>(times_.data() + warm_up_),
                   static_cast<std::streamsize>((times_.size() - warm_up_) * sizeof(double)));
        std::rename((file_ + ".part").c_str(), file_.c_str()); // the reader finds the whole file or none
    }

    std::string file_;
    bool measures_ping_; // otherwise the way back
    std::size_t samples_;
    double seconds_;
    bool cold_;
    std::size_t warm_up_;
    std::uint64_t sequence_ = 0, deadline_ = 0;
    std::vector<double> times_; // ns
    bool done_ = false;
};

} // namespace tandem::bench
