// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/test_picture.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <device/MultiCamera.h>
#include <string>
#include <vector>

namespace {

/// `Count` test pictures of the sizes `Width0`, `Height0`, `PixelBytes0`, `Width1` and so on.
class SimulatedMultiCamera : public tandem::devices::SimulatedDevice<MultiCamera> {
  public:
    int GetImage(unsigned char* image) override { return GetImage(0, image); }
    int GetImage(int index, unsigned char* image) override {
        if (!image || index < 0) return API_ERROR;
        bool there = false;
        const int result = serve([&](double seconds, double) {
            there = static_cast<std::size_t>(index) < sizes_.size();
            if (there)
                tandem::devices::draw_test_picture(image, sizes_[static_cast<std::size_t>(index)], seconds);
        });
        return there ? result : API_ERROR;
    }

  protected:
    void configure() override {
        sizes_.clear();
        for (int i = 0; i < count("Count", 1); ++i) {
            const std::string number = std::to_string(i);
            sizes_.push_back({count(("Width" + number).c_str(), 320), count(("Height" + number).c_str(), 240),
                              count(("PixelBytes" + number).c_str(), 3)});
        }
    }

  private:
    std::vector<tandem::devices::PictureSize> sizes_;
};

} // namespace

TANDEM_DEVICE(SimulatedMultiCamera)
