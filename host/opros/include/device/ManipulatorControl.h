// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MANIPULATORCONTROL_H_
#define DEVICE_MANIPULATORCONTROL_H_

#include "Device.h"
#include "ObjectPositionData.h"
#include "OprosPrintMessage.h"

/// An arm that executes lists of poses or joint angles, in the background and under a motion's number. OPRoS v2.
class ManipulatorControl : public Device {
  public:
    ManipulatorControl() {}
    virtual ~ManipulatorControl() {}
    virtual std::int32_t StopMotion() { return API_NOT_SUPPORTED; }
    virtual std::int32_t RunHardHome() { return API_NOT_SUPPORTED; }
    virtual std::int32_t RunSoftHome() { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetJointAngles(std::vector<OPRoS::Float32>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetJointAngle(std::int16_t /*joint*/, float32_t&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t RunXYZList(std::vector<OPRoS::ObjectPositionData>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t RunJointList(std::vector<OPRoS::Float32Array>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t RunJointListContinue(std::vector<OPRoS::Float32Array>&,
                                              OPRoS::Int32Array& /*time*/) {
        return API_NOT_SUPPORTED;
    }
    virtual std::int32_t SetMotionID(std::int16_t) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetCompletedMotionID(std::int16_t&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetAccel(float32_t) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetVelocity(float32_t) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetMotionDelay(std::int16_t) { return API_NOT_SUPPORTED; }
    virtual std::int32_t InterpolationType(std::int16_t) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetEncoderType(std::int16_t) { return API_NOT_SUPPORTED; }

  protected:
    int m_MotionID = 0, m_Interpolation = 0, m_EncoderType = 0;
    virtual std::int32_t SetPower(std::vector<OPRoS::Float64>) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetPower(std::vector<OPRoS::Float64>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetVelocity(std::vector<OPRoS::Float64>) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetVelocity(std::vector<OPRoS::Float64>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetPosition(std::vector<OPRoS::Float64>) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetPosition(std::vector<OPRoS::Float64>&) { return API_NOT_SUPPORTED; }
};

#endif
