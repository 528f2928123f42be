// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <deque>

namespace tandem::devices {

/// A line that is looped back: what is written can be read, up to 1 MB. Read() returns how many bytes it has
/// given.
template <typename Class>
class SimulatedBus : public SimulatedDevice<Class> {
  public:
    int Write(unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        const int result = this->serve([&](double, double) { put(data, size); });
        return result == API_SUCCESS ? size : result;
    }
    int Read(unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        int given = 0;
        const int result = this->serve([&](double, double) { given = take(data, size); });
        return result == API_SUCCESS ? given : result;
    }

  private:
    static constexpr std::size_t most = 1 << 20;

    void put(const unsigned char* data, int size) {
        line_.insert(line_.end(), data, data + size);
        while (line_.size() > most) line_.pop_front();
    }
    int take(unsigned char* data, int size) {
        const auto count = std::min(line_.size(), static_cast<std::size_t>(size));
        const auto end = line_.begin() + static_cast<std::ptrdiff_t>(count);
        std::copy(line_.begin(), end, data);
        line_.erase(line_.begin(), end);
        return static_cast<int>(count);
    }

    std::deque<unsigned char> line_;
};

} // namespace tandem::devices
