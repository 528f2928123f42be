// SPDX-License-Identifier: Apache-2.0
// The windows of a paired case, in the measuring component: a number of messages through the bridge, then the
// same number over the floor, and the ratio of their medians.
#pragma once
#include "apps/bench/tandem/bridge/floor.hpp"

#include <cmath>
#include <optional>

namespace tandem::bench {

/// [one thread at a time]
class PairedWindow {
  public:
    /// `messages`: number of messages of each half that count.
    PairedWindow(const std::string& floor_file, std::size_t messages)
        : floor_(floor_file, Floor::Role::measures), messages_(messages) {
        for (auto& half : halves_) half.reserve(messages_); // no allocation beside a message
    }

    Floor& floor() { return floor_; }
    /// Returns whether the next message goes over the floor.
    bool on_floor() const { return on_floor_; }

    bool begins_half() const { return taken_ == 0; }

    /// Adds the time of a message over the path in use. With the first message of each window, returns the
    /// ratio of the previous window: not a number if one of the threads had lost its core. The first message
    /// of each half finds its path cold and does not count.
    std::optional<double> add(double ns) {
        if (taken_++ == 0) return on_floor_ ? std::nullopt : begin_window();
        half().push_back(ns);
        if (half().size() == messages_) {
            on_floor_ = !on_floor_;
            taken_ = 0;
            floor_.change_road();
        }
        return std::nullopt;
    }

  private:
    std::vector<double>& half() { return halves_[on_floor_ ? 1 : 0]; }
    /// Call it when the peer has answered over the bridge again: it has then reported the switches of its
    /// floor thread.
    std::optional<double> begin_window() {
        floor_.note_switches();
        const std::uint64_t switches = floor_.switches();
        const bool undisturbed = std::exchange(switches_, switches) == switches;
        if (halves_[1].empty()) return std::nullopt; // the first one
        const double floor_ns = median(halves_[1]), ratio = median(halves_[0]) / floor_ns;
        for (auto& half : halves_) half.clear();
        if (!undisturbed) return NAN;
        floor_.add_time(floor_ns);
        return ratio;
    }
    static double median(std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    Floor floor_;
    std::size_t messages_, taken_ = 0;
    std::vector<double> halves_[2]; // bridge, floor
    bool on_floor_ = false;
    std::uint64_t switches_ = 0;
};

} // namespace tandem::bench
