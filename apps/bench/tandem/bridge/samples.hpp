// SPDX-License-Identifier: Apache-2.0
// The times that a component of the bridge's cases has measured, and how they reach the bench.
#pragma once
#include "apps/bench/machine/clock.hpp"

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace tandem::bench {

/// [one thread] Times in ns, written to a file as doubles when there are `samples` of them or `seconds` have
/// passed. The first `warm_up` times are left out.
class Samples {
  public:
    Samples(std::string file, std::size_t samples, double seconds, std::size_t warm_up)
        : file_(std::move(file)), samples_(samples), seconds_(seconds), warm_up_(warm_up) {
        times_.reserve(warm_up_ + samples_); // no allocation falls into a measured time
    }

    /// `now`: the clock at the end of this one, in ticks.
    void add(double ns, std::uint64_t now) {
        if (done_) return;
        if (times_.empty()) deadline_ = now + to_ticks(seconds_ * 1e9);
        times_.push_back(ns);
        if (times_.size() >= warm_up_ + samples_ || (now >= deadline_ && times_.size() > warm_up_)) write();
    }
    bool empty() const { return times_.empty(); }
    bool done() const { return done_; }

  private:
    void write() {
        done_ = true;
        std::ofstream(file_ + ".part", std::ios::binary)
            .write(reinterpret_cast<const char*>(times_.data() + warm_up_),
                   static_cast<std::streamsize>((times_.size() - warm_up_) * sizeof(double)));
        std::rename((file_ + ".part").c_str(), file_.c_str()); // the reader finds the complete file or none
    }

    std::string file_;
    std::size_t samples_;
    double seconds_;
    std::size_t warm_up_;
    std::uint64_t deadline_ = 0;
    std::vector<double> times_;
    bool done_ = false;
};

} // namespace tandem::bench
