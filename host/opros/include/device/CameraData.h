// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_CAMERADATA_H_
#define DEVICE_CAMERADATA_H_

#include "ApiMembers.h"
#include "ApiValues.h"

namespace OPRoS {

/// A picture. OPRoS v2. The camera and the component agree on the numbers of formats.
class CameraData {
  public:
    ReturnType status = OPROS_SUCCESS;
    std::int32_t format = 0, width = 0, height = 0;
    std::vector<std::uint8_t> data;
    CameraData() {}
    CameraData(std::int32_t format_, std::int32_t width_, std::int32_t height_,
               const std::vector<std::uint8_t>& data_)
        : format(format_), width(width_), height(height_), data(data_) {}
    OPROS_API_MEMBERS(status, format, width, height, data)
};
OPROS_API_TYPE_NAME(CameraData)

} // namespace OPRoS

#endif
