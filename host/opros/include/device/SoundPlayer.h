// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SOUNDPLAYER_H_
#define DEVICE_SOUNDPLAYER_H_

#include "OprosApi.h"

#define SOUND_PLAYER_TEXT_STREAM 0
#define SOUND_PLAYER_TEXT_FILE 1
#define SOUND_PLAYER_WAVE_STREAM 2
#define SOUND_PLAYER_WAVE_FILE 3

/// A loudspeaker: OPRoS v1. `mode` determines whether `sound` is a text, the name of a file, or samples.
class SoundPlayer : public OprosApi {
  public:
    SoundPlayer() {}
    virtual ~SoundPlayer() {}
    virtual int Play(std::string /*sound*/, int /*mode*/) { return API_NOT_SUPPORTED; }
    virtual int Stop() { return API_NOT_SUPPORTED; }
};

#endif
