// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_CAMERA_H_
#define DEVICE_CAMERA_H_

#include "CameraData.h"
#include "OprosApi.h"

/// A camera. `image` is the caller's memory for one image of the size in the device's properties.
class Camera : public OprosApi {
  public:
    Camera() {}
    virtual ~Camera() {}
    virtual int GetImage(unsigned char* /*image*/) { return API_NOT_SUPPORTED; }
    /// Delivers images through a callback until EndPushImage(). The device defines the callback's type.
    virtual int StartPushImage(void* /*callback*/) { return API_NOT_SUPPORTED; }
    virtual int EndPushImage() { return API_NOT_SUPPORTED; }

    // The forms of OPRoS v2.
    virtual std::int32_t GetImage(OPRoS::CameraData&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t StartPushImage(std::int32_t /*period*/, std::int32_t /*format*/,
                                        std::int32_t /*width*/, std::int32_t /*height*/, void* /*callback*/,
                                        void* /*argument*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
