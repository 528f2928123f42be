// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <deque>

namespace tandem::devices {

/// A byte stream in loopback: written bytes can be read. Keeps the newest 1 MiB. For the device classes Socket, Uart
/// and Usb.
template <typename Class>
class SimulatedBus : public SimulatedDevice<Class> {
  public:
    /// Returns `size`, or API_ERROR.
    int Write(unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        const int result = this->perform([&] { append(data, size); });
        return result == API_SUCCESS ? size : result;
    }
    /// Returns the number of bytes read, at most `size`, or API_ERROR. Does not wait.
    int Read(unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        int count = 0;
        const int result = this->perform([&] { count = remove_front(data, size); });
        return result == API_SUCCESS ? count : result;
    }

  private:
    // Limits the memory of a component that writes and never reads.
    static constexpr std::size_t max_bytes = 1 << 20;

    void append(const unsigned char* data, int size) {
        bytes_.insert(bytes_.end(), data, data + size);
        while (bytes_.size() > max_bytes) bytes_.pop_front();
    }
    int remove_front(unsigned char* data, int size) {
        const auto count = std::min(bytes_.size(), static_cast<std::size_t>(size));
        const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(count);
        std::copy(bytes_.begin(), end, data);
        bytes_.erase(bytes_.begin(), end);
        return static_cast<int>(count);
    }

    std::deque<unsigned char> bytes_;
};

} // namespace tandem::devices
