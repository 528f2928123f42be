// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MULTICAMERA_H_
#define DEVICE_MULTICAMERA_H_

#include "Camera.h"

/// Several cameras.
class MultiCamera : public Camera {
  public:
    MultiCamera() {}
    virtual ~MultiCamera() {}
    using Camera::GetImage;
    virtual int GetImage(int /*index*/, unsigned char* /*image*/) { return API_NOT_SUPPORTED; }
};

#endif
