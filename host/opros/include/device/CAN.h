// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_CAN_V1_H_
#define DEVICE_CAN_V1_H_

#include "Can.h"

/// The settings of a channel in OPRoS v1, for components that store them.
class CANProfile {
  public:
    CANProfile()
        : timeOut(0), channel(-1), bitRate(0), acceptanceMask(0), acceptanceCode(0), isExtended(false) {}
    virtual ~CANProfile() {}
    unsigned long timeOut;
    int channel;
    unsigned long bitRate, acceptanceMask, acceptanceCode;
    bool isExtended;
};

/// Its name in OPRoS v1.
typedef Can CAN;

#endif
