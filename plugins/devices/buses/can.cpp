// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <device/Can.h>

namespace {

/// A CAN bus in loopback. Returns frames of up to 8 bytes in the order of writing, and keeps the newest 1000. Without a
/// frame, Read() returns id 0 and zeros.
class SimulatedCan : public tandem::devices::SimulatedDevice<Can> {
  public:
    /// `size`: at most 8 bytes, as on the bus.
    int Write(long id, unsigned char* data, int size) override {
        if (size < 0 || size > 8 || (!data && size > 0)) return API_ERROR;
        return perform([&] {
            Frame frame{id, {}};
            std::copy_n(data, size, frame.data.begin());
            frames_.push_back(frame);
            if (frames_.size() > 1000) frames_.pop_front();
        });
    }
    /// Returns without waiting.
    int Read(long& id, unsigned char* data, int size) override {
        if (size < 0 || size > 8 || (!data && size > 0)) return API_ERROR;
        return perform([&] {
            const Frame frame = frames_.empty() ? Frame{0, {}} : frames_.front();
            if (!frames_.empty()) frames_.pop_front();
            id = frame.id;
            std::copy_n(frame.data.begin(), size, data);
        });
    }

  private:
    struct Frame {
        long id;
        std::array<unsigned char, 8> data;
    };
    std::deque<Frame> frames_;
};

} // namespace

TANDEM_DEVICE(Can, SimulatedCan)
