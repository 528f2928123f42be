// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GRIPPER_H_
#define DEVICE_GRIPPER_H_

#include "Manipulator.h"

/// A hand that holds an object from StartGripping() to StopGripping().
class Gripper : public Manipulator {
  public:
    Gripper() {}
    virtual ~Gripper() {}
    virtual int StartGripping() { return API_NOT_SUPPORTED; }
    virtual int StopGripping() { return API_NOT_SUPPORTED; }
    virtual int IsGripped(bool&) { return API_NOT_SUPPORTED; }
    /// OPRoS v1: returns whether it holds an object.
    virtual int IsGripped() { return API_NOT_SUPPORTED; }
};

#endif
