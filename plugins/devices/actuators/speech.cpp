// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/Speech.h>

namespace {

/// Has spoken as soon as it is asked, without a sound.
class SimulatedSpeech : public tandem::devices::SimulatedDevice<Speech> {
  public:
    int PlaySpeech(std::string, int) override {
        return serve([](double, double) {});
    }
    int StopSpeech() override {
        return serve([](double, double) {});
    }
};

} // namespace

TANDEM_DEVICE(SimulatedSpeech)
