// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SOUNDRECORDER_H_
#define DEVICE_SOUNDRECORDER_H_

#include "OprosApi.h"

#define SOUND_RECORDER_BUFFER 0
#define SOUND_RECORDER_FILE 1

/// A microphone: OPRoS v1.
class SoundRecorder : public OprosApi {
  public:
    SoundRecorder() {}
    virtual ~SoundRecorder() {}
    virtual int StartRecording(std::string /*sound*/, int /*mode*/) { return API_NOT_SUPPORTED; }
    virtual int StopRecording() { return API_NOT_SUPPORTED; }
    virtual int GetRecordedData(std::vector<unsigned char>&) { return API_NOT_SUPPORTED; }
};

#endif
