// SPDX-License-Identifier: Apache-2.0
// What the OPRoS and the RTM component of the bridge's measurement share: eight doubles go there and come
// back, each side polling its port, and carry the clock's readings at their sending and receiving. Both
// directions are measured by the one clock of the machine, the time-stamp counter (or CLOCK_MONOTONIC_RAW).
#pragma once
#include "apps/bench/harness/clock.hpp"

#include <array>
#include <bit>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace tandem::bench {

/// sequence, then the readings: asked, arrived, answered; the rest is payload.
using PingMessage = std::array<double, 8>;

inline double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
inline std::uint64_t as_bits(double value) { return std::bit_cast<std::uint64_t>(value); }

constexpr double slice_ns = 20e6; ///< of one onExecute(): the host gets its thread back in between

/// The answering side. Port: bool receive(PingMessage&), void send(const PingMessage&).
template <class Port>
void answer_for_a_slice(Port& port) {
    const std::uint64_t end = ticks() + to_ticks(slice_ns);
    PingMessage message;
    for (std::uint64_t now = ticks(); now < end; now = ticks()) {
        if (!port.receive(message)) continue;
        message[2] = as_double(ticks());
        message[3] = as_double(ticks());
        port.send(message);
    }
}

/// The asking side: keeps asking until the link is up, warms up, measures, writes the file, is done.
class Asker {
  public:
    Asker(std::string file, bool there, std::size_t samples, double seconds)
        : file_(std::move(file)), there_(there), samples_(samples), seconds_(seconds) {}

    template <class Port>
    void ask_for_a_slice(Port& port) {
        const std::uint64_t end = ticks() + to_ticks(slice_ns);
        while (!done_ && ticks() < end)
            if (!ask(port, end)) return; // not answered within the slice: ask anew
        if (!done_ && times_.size() >= warm_up + samples_) write();
    }

  private:
    static constexpr std::size_t warm_up = 2000;

    template <class Port>
    bool ask(Port& port, std::uint64_t end) {
        PingMessage message{};
        message[0] = static_cast<double>(++sequence_);
        message[1] = as_double(ticks());
        port.send(message);
        PingMessage reply;
        do {
            while (!port.receive(reply))
                if (ticks() >= end) return false;
        } while (reply[0] != message[0]); // one of an earlier slice
        const std::uint64_t now = ticks();
        if (times_.empty()) until_ = now + to_ticks(seconds_ * 1e9);
        times_.push_back(to_ns(there_ ? as_bits(reply[2]) - as_bits(reply[1]) : now - as_bits(reply[3])));
        if (times_.size() >= warm_up + samples_ || (now >= until_ && times_.size() > warm_up)) write();
        return !done_;
    }
    void write() {
        done_ = true;
        std::ofstream(file_ + ".part", std::ios::binary)
            .write(reinterpret_cast<const char*>(times_.data() + warm_up),
                   static_cast<std::streamsize>((times_.size() - warm_up) * sizeof(double)));
        std::rename((file_ + ".part").c_str(), file_.c_str()); // whole, or not there
    }

    std::string file_;
    bool there_;
    std::size_t samples_;
    double seconds_;
    std::uint64_t sequence_ = 0, until_ = 0;
    std::vector<double> times_;
    bool done_ = false;
};

} // namespace tandem::bench
