// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_DEVICEPARAMETERS_H_
#define DEVICE_DEVICEPARAMETERS_H_

#include <cstdlib>
#include <string>
#include <vector>

namespace OPRoS {

/// The name, mounting pose and range of a device, from nine words. Other numbers of words leave the name empty. OPRoS v2.
class CDeviceParameters {
  public:
    CDeviceParameters(std::vector<std::string>& words) : numbers_(8, 0.0) {
        if (words.size() != numbers_.size() + 1) return;
        name_ = words[0];
        for (std::size_t i = 0; i < numbers_.size(); ++i) numbers_[i] = atof(words[i + 1].c_str());
    }
    std::string getDeviceName() { return name_; }
    double getX() { return numbers_[0]; }
    double getY() { return numbers_[1]; }
    double getZ() { return numbers_[2]; }
    double getRoll() { return numbers_[3]; }
    double getPitch() { return numbers_[4]; }
    double getYaw() { return numbers_[5]; }
    double getMin() { return numbers_[6]; }
    double getMax() { return numbers_[7]; }

  private:
    std::string name_;
    std::vector<double> numbers_;
};

} // namespace OPRoS

#endif
