// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_COLORRECOGNITION_H_
#define DEVICE_COLORRECOGNITION_H_

#include "OprosApi.h"

/// Finds colours in given ranges: OPRoS v1.
class ColorRecognition : public OprosApi {
  public:
    ColorRecognition() {}
    virtual ~ColorRecognition() {}
    /// Returns one result per region found. The image has `height` rows of `width` pixels of `pixelbyte` bytes.
    virtual std::valarray<VisionRecognitionResult> recognize(unsigned char* image, int width, int height,
                                                             int pixelbyte) = 0;
    /// Adds a colour: its name and the ranges of its three channels. Returns false if this is not possible.
    virtual bool addItem(std::string name, unsigned char min1, unsigned char max1, unsigned char min2,
                         unsigned char max2, unsigned char min3, unsigned char max3) = 0;
    virtual bool removeItem(std::string name) = 0;
    virtual bool cleanUpItems() = 0;
};

#endif
