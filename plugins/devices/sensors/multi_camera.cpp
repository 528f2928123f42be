// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/test_picture.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <device/MultiCamera.h>
#include <string>
#include <vector>

namespace {

/// `Count` test pictures. The first has the size `Width0`, `Height0`, `PixelBytes0`, the second `Width1`, ...
class SimulatedMultiCamera : public tandem::devices::SimulatedDevice<MultiCamera> {
  public:
    int GetImage(unsigned char* image) override { return GetImage(0, image); }
    int GetImage(int index, unsigned char* image) override {
        if (!image || index < 0) return API_ERROR;
        bool exists = false;
        const int result = perform([&](double seconds, double) {
            exists = static_cast<std::size_t>(index) < sizes_.size();
            if (exists)
                tandem::devices::draw_test_picture(image, sizes_[static_cast<std::size_t>(index)], seconds);
        });
        return exists ? result : API_ERROR;
    }

  protected:
    void configure() override {
        sizes_.clear();
        for (int i = 0; i < count_parameter("Count", 1); ++i) {
            const std::string number = std::to_string(i);
            sizes_.push_back({count_parameter("Width" + number, 320), count_parameter("Height" + number, 240),
                              count_parameter("PixelBytes" + number, 3)});
        }
    }

  private:
    std::vector<tandem::devices::PictureSize> sizes_;
};

} // namespace

TANDEM_DEVICE(MultiCamera, SimulatedMultiCamera)
