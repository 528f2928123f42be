// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_VOICERECOGNITION_H_
#define DEVICE_VOICERECOGNITION_H_

#include "OprosApi.h"

/// Recognizes spoken words: OPRoS v1.
class VoiceRecognition : public OprosApi {
  public:
    VoiceRecognition() {}
    virtual ~VoiceRecognition() {}
    virtual int GetResult(std::string*) { return API_NOT_SUPPORTED; }
};

#endif
