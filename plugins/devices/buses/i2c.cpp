// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <device/I2C.h>
#include <map>
#include <vector>

namespace {

/// An I2C bus with a memory at every address that keeps the last bytes written to it. Unwritten bytes read as 0.
class SimulatedI2C : public tandem::devices::SimulatedDevice<I2C> {
  public:
    int Write(unsigned long address, unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        return perform([&] { memory_[address].assign(data, data + size); });
    }
    int Read(unsigned long address, unsigned char* data, int size) override {
        if (!data || size < 0) return API_ERROR;
        return perform([&] {
            const std::vector<unsigned char>& bytes = memory_[address];
            std::fill_n(data, size, static_cast<unsigned char>(0));
            std::copy_n(bytes.begin(), std::min(bytes.size(), static_cast<std::size_t>(size)), data);
        });
    }

  private:
    std::map<unsigned long, std::vector<unsigned char>> memory_;
};

} // namespace

TANDEM_DEVICE(I2c, SimulatedI2C)
