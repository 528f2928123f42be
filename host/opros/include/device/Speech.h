// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SPEECH_H_
#define DEVICE_SPEECH_H_

#include "OprosApi.h"

#define SPEECH_TEXT_STREAM 0
#define SPEECH_TEXT_FILE 1

/// A speech synthesizer. `mode` determines whether `text` is the text or the name of its file.
class Speech : public OprosApi {
  public:
    Speech() {}
    virtual ~Speech() {}
    virtual int PlaySpeech(std::string /*text*/, int /*mode*/) { return API_NOT_SUPPORTED; }
    virtual int StopSpeech() { return API_NOT_SUPPORTED; }
};

#endif
