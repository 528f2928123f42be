// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/test_picture.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <device/Camera.h>

namespace {

/// A test picture of the size that the component asks for.
class SimulatedCamera : public tandem::devices::SimulatedDevice<Camera> {
  public:
    int GetImage(unsigned char* image) override {
        if (!image) return API_ERROR;
        return serve(
            [&](double seconds, double) { tandem::devices::draw_test_picture(image, size_, seconds); });
    }

  protected:
    void configure() override { size_ = {count("Width", 320), count("Height", 240), count("PixelBytes", 3)}; }

  private:
    tandem::devices::PictureSize size_{320, 240, 3};
};

} // namespace

TANDEM_DEVICE(SimulatedCamera)
