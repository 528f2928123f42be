// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/Speech.h>

namespace {

/// Is silent: finishes each text at once.
class SimulatedSpeech : public tandem::devices::SimulatedDevice<Speech> {
  public:
    int PlaySpeech(std::string, int) override {
        return perform([] {});
    }
    int StopSpeech() override {
        return perform([] {});
    }
};

} // namespace

TANDEM_DEVICE(Speech, SimulatedSpeech)
