// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/standard_type.hpp"

#include "proxy/wire/signature_match.hpp"

#include <rtm/InterfaceSignatures.h>

namespace tandem::interceptor {
namespace {

// The types that travel by themselves, which RTCs have ports of.
constexpr const char* standard_types[] = {"TimedShort",      "TimedLong",         "TimedUShort",
                                          "TimedULong",      "TimedFloat",        "TimedDouble",
                                          "TimedChar",       "TimedBoolean",      "TimedOctet",
                                          "TimedString",     "TimedShortSeq",     "TimedLongSeq",
                                          "TimedUShortSeq",  "TimedULongSeq",     "TimedFloatSeq",
                                          "TimedDoubleSeq",  "TimedCharSeq",      "TimedBooleanSeq",
                                          "TimedOctetSeq",   "TimedStringSeq",    "TimedPoint2D",
                                          "TimedPose2D",     "TimedVelocity2D",   "TimedPoseVel2D",
                                          "TimedGeometry2D", "TimedCovariance2D", "TimedPoint3D",
                                          "TimedPose3D",     "TimedVelocity3D",   "TimedPoseVel3D",
                                          "TimedGeometry3D", "TimedCovariance3D", "TimedSpeedHeading3D",
                                          "TimedOAP",        "TimedQuaternion",   "ActArrayActuatorPos",
                                          "ActArrayState",   "CameraImage",       "Fiducials",
                                          "GPSData",         "GripperState",      "INSData",
                                          "LimbState",       "Hypotheses2D",      "Hypotheses3D",
                                          "Features",        "MultiCameraImages", "Path2D",
                                          "Path3D",          "PointCloud",        "PanTiltAngles",
                                          "RangeData",       "IntensityData"};

} // namespace

std::string standard_type(std::string_view signature) {
    for (const std::string name : standard_types) {
        const std::string id = "IDL:RTC/" + name + ":1.0";
        const std::string known = RTC::InterfaceSignatures::type(id);
        if (known.empty() || known.find('?') != std::string::npos) continue;
        const auto match = wire::match_signatures(signature, known);
        if (match == wire::SignatureMatch::equal || match == wire::SignatureMatch::add_time) return id;
    }
    return "";
}

} // namespace tandem::interceptor
