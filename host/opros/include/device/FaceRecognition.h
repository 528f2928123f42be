// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_FACERECOGNITION_H_
#define DEVICE_FACERECOGNITION_H_

#include "OprosApi.h"

/// Finds faces that it has learnt from a file: OPRoS v1.
class FaceRecognition : public OprosApi {
  public:
    FaceRecognition() {}
    virtual ~FaceRecognition() {}
    /// Returns one result per face found. The image has `height` rows of `width` pixels of `pixelbyte` bytes.
    virtual std::valarray<VisionRecognitionResult> recognize(unsigned char* image, int width, int height,
                                                             int pixelbyte) = 0;
    virtual bool addItem(std::string fileName) = 0;
    virtual bool removeItem(std::string name) = 0;
    virtual bool cleanUpItems() = 0;
};

#endif
