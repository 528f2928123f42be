// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/Joystick.h>

namespace {

/// A stick that moves around a circle in ten seconds (x and y from -1 to 1), and `Buttons` buttons that are pressed in
/// turn for a second each.
class SimulatedJoystick : public tandem::devices::SimulatedDevice<Joystick> {
  public:
    int GetJoystickData(JoystickData& data) override {
        return perform([&](double seconds, double) {
            data.x = std::cos(0.2 * M_PI * seconds);
            data.y = std::sin(0.2 * M_PI * seconds);
            data.z = 0;
            data.button.assign(static_cast<std::size_t>(buttons_), false);
            data.button[static_cast<std::size_t>(seconds) % data.button.size()] = true;
        });
    }

  protected:
    void configure() override { buttons_ = count_parameter("Buttons", 8); }

  private:
    int buttons_ = 8;
};

} // namespace

TANDEM_DEVICE(Joystick, SimulatedJoystick)
