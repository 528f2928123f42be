// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/test_picture.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <device/Camera.h>

namespace {

/// A test picture of the requested size: `Width`, `Height`, `PixelBytes`.
class SimulatedCamera : public tandem::devices::SimulatedDevice<Camera> {
  public:
    /// The component has allocated the picture according to the same properties.
    int GetImage(unsigned char* image) override {
        if (!image) return API_ERROR;
        return perform(
            [&](double seconds, double) { tandem::devices::draw_test_picture(image, size_, seconds); });
    }
    /// Keeps the format, whose numbers are the component's.
    int GetImage(OPRoS::CameraData& image) override {
        return perform([&](double seconds, double) {
            image.width = size_.width;
            image.height = size_.height;
            image.data.resize(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height) *
                              static_cast<std::size_t>(size_.pixel_bytes));
            tandem::devices::draw_test_picture(image.data.data(), size_, seconds);
        });
    }

  protected:
    void configure() override {
        size_ = {count_parameter("Width", 320), count_parameter("Height", 240),
                 count_parameter("PixelBytes", 3)};
    }

  private:
    tandem::devices::PictureSize size_{320, 240, 3};
};

} // namespace

TANDEM_DEVICE(Camera, SimulatedCamera)
