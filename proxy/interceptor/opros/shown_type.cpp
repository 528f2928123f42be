// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/shown_type.hpp"

#include "proxy/interceptor/corba/typecode.hpp"
#include "proxy/interceptor/engine/data_types.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <rtm/InterfaceSignatures.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tandem::interceptor {
namespace {

// OpenRTM-aist's data types that RTCs use as types of ports.
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

/// Returns the signatures with the same bytes: the given one and, for a string followed by a structure, the string followed by
/// the structure's members.
std::vector<std::string> equal_signatures(const std::string& signature) {
    std::vector<std::string> signatures{wire::to_signature(wire::parse_signature(signature))};
    const auto type = wire::parse_signature(signature);
    if (type.children.size() < 2 || type.children.front().kind != wire::Kind::string) return signatures;
    wire::Type content = type;
    content.children.erase(content.children.begin());
    signatures.push_back("s(" + wire::to_signature(content) + ")");
    return signatures;
}

/// Returns whether one of the signatures fits the known type; its leading time is added.
bool fits(const std::vector<std::string>& signatures, const std::string& id) {
    const std::string known = engine::data_type_signature(id);
    if (known.empty() || known.find('?') != std::string::npos) return false;
    return std::any_of(signatures.begin(), signatures.end(), [&](const auto& signature) {
        const auto match = wire::match_signatures(signature, known);
        return match == wire::SignatureMatch::equal || match == wire::SignatureMatch::add_time;
    });
}

} // namespace

ShownType shown_type(const link::Port& port) {
    const auto signatures = equal_signatures(port.signature);
    const std::string named = repository_id(port.type);
    const std::string known = engine::data_type_signature(named);
    if (!known.empty() && !fits(signatures, named))
        throw std::runtime_error(fmt::format(
            "its members are '{}', those of {} are '{}'; name another structure with AdaptorComp's "
            "property 'interfaces'",
            signatures.front(), named, wire::without_names(known)));
    if (!known.empty()) return {named, known};
    for (const std::string name : standard_types)
        if (std::string id = "IDL:RTC/" + name + ":1.0"; fits(signatures, id))
            return {id, engine::data_type_signature(id)};
    if (named.starts_with("IDL:OPRoS/")) return {"IDL:OPRoS/" + signatures.front() + ":1.0", port.signature};
    for (const auto& id : RTC::InterfaceSignatures::types())
        if (const auto signature = engine::data_type_signature(id);
            fits(signatures, id) && wire::is_timed(signature))
            return {id, signature};
    throw std::runtime_error(fmt::format("no data type of RTM that this host knows has the members of OPRoS "
                                         "type {}, '{}', after a time; load an RTC "
                                         "whose IDL has such a structure before InterceptorComp",
                                         port.type, signatures.front()));
}

} // namespace tandem::interceptor
