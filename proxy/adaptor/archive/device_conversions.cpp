// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/device_conversions.hpp"

namespace tandem::adaptor {
namespace {

struct DeviceConversion {
    std::string_view opros;
    std::size_t fields; ///< of the OPRoS type, because v1.1 and v2 have types of one name; 0: any
    std::string_view rtm, to_rtm, to_opros;
};

// The fields of a GPS of v1.1 are latitude, longitude, time as a text, and velocity.
constexpr std::string_view gps_to_rtm =
    "latitude: from 1; longitude: from 2; horizontalSpeed: from 4; drop 3; timeFromGPS: default 0; altitude: "
    "default "
    "0; horizontalError: default 0; verticalError: default 0; heading: default 0; verticalSpeed: default 0; "
    "numSatellites: default 0; fixType: default 1";
constexpr std::string_view gps_to_opros = "1: from latitude; 2: from longitude; 3: default ; 4: from "
                                          "horizontalSpeed; drop timeFromGPS; drop altitude; "
                                          "drop horizontalError; drop verticalError; drop heading; drop "
                                          "verticalSpeed; drop numSatellites; drop fixType";

// The fields of a posture are three turning rates, three accelerations and three angles.
constexpr DeviceConversion device_conversions[] = {
    {"ObjectLocation", 3, "TimedPose2D", "positions", "positions"},
    {"ObjectPosition", 6, "TimedPose3D", "positions", "positions"},
    {"CartesianCoordinate", 6, "TimedPose3D", "positions", "positions"},
    {"WheelControlVelocity", 2, "TimedVelocity2D", "vx: from 1; vy: default 0; va: from 2",
     "1: from vx; 2: from va; drop vy"},
    {"ObjectPosture", 9, "TimedAngularVelocity3D",
     "avx: from 1; avy: from 2; avz: from 3; drop 4; drop 5; drop 6; drop 7; drop 8; drop 9",
     "1: from avx; 2: from avy; 3: from avz; 4: default 0; 5: default 0; 6: default 0; 7: default 0; 8: "
     "default 0; "
     "9: default 0"},
    {"ObjectPosture", 9, "TimedAcceleration3D",
     "ax: from 4; ay: from 5; az: from 6; drop 1; drop 2; drop 3; drop 7; drop 8; drop 9",
     "4: from ax; 5: from ay; 6: from az; 1: default 0; 2: default 0; 3: default 0; 7: default 0; 8: default "
     "0; "
     "9: default 0"},
    {"ObjectPosture", 9, "TimedOrientation3D",
     "r: from 7; p: from 8; y: from 9; drop 1; drop 2; drop 3; drop 4; drop 5; drop 6",
     "7: from r; 8: from p; 9: from y; 1: default 0; 2: default 0; 3: default 0; 4: default 0; 5: default 0; "
     "6: default 0"},
    {"GpsData", 4, "GPSData", gps_to_rtm, gps_to_opros},
    {"GPSData", 4, "GPSData", gps_to_rtm, gps_to_opros},
    {"std::vector<double>", 0, "RangeData", "ranges: from 1; geometry: default 0; config: default 0",
     "1: from ranges; drop geometry; drop config"},
    // The sixth field is the pixels, which have no name in the archive. Most camera RTCs set no bpp, so that only their
    // pixels say how many bytes each has. pictures.hpp checks the rest.
    {"RawImage", 6, "CameraImage",
     "narrow; width: from width; height: from height; bpp: from pixelByte * 8; format: from raw; fDiv: "
     "default 0; "
     "pixels: from 6 first width height pixelByte; drop size",
     "narrow; refuse format jpeg jpg png gif tiff webp h26; raw: default raw; width: from width; "
     "height: from height; pixelByte: count pixels per width height; size: count pixels; 6: from pixels; "
     "drop bpp; drop fDiv"},
};

// Types of v2 begin with the status of the call that produced them. Device components also put the codes of the device
// API there: API_SUCCESS is 0.
constexpr std::string_view status_to_rtm = "refuse 1 unless 200 202 300 0; ",
                           status_to_opros = "1: default 200; ";
constexpr std::string_view gps_v2_to_rtm =
    "latitude: from 2; longitude: from 3; horizontalSpeed: from 5; drop 4; timeFromGPS: default 0; altitude: "
    "default 0; horizontalError: default 0; verticalError: default 0; heading: default 0; verticalSpeed: "
    "default 0; "
    "numSatellites: default 0; fixType: default 1";
constexpr std::string_view gps_v2_to_opros = "2: from latitude; 3: from longitude; 4: default ; 5: from "
                                             "horizontalSpeed; drop timeFromGPS; drop altitude; "
                                             "drop horizontalError; drop verticalError; drop heading; drop "
                                             "verticalSpeed; drop numSatellites; drop fixType";

// Each is preceded by the conversion of the status.
constexpr DeviceConversion device_conversions_v2[] = {
    {"MobilePositionData", 4, "TimedPose2D", "position.x: from 2; position.y: from 3; heading: from 4",
     "2: from position.x; 3: from position.y; 4: from heading"},
    {"MobileVelocityData", 4, "TimedVelocity2D", "vx: from 2; vy: from 3; va: from 4",
     "2: from vx; 3: from vy; 4: from va"},
    {"MobileAccelerationData", 4, "TimedAcceleration2D", "ax: from 2; ay: from 3; drop 4",
     "2: from ax; 3: from ay; 4: default 0"},
    {"ObjectPositionData", 7, "TimedPose3D",
     "position.x: from 2; position.y: from 3; position.z: from 4; orientation.r: from 5; "
     "orientation.p: from 6; orientation.y: from 7",
     "2: from position.x; 3: from position.y; 4: from position.z; 5: from orientation.r; "
     "6: from orientation.p; 7: from orientation.y"},
    {"ObjectVelocityData", 7, "TimedVelocity3D",
     "vx: from 2; vy: from 3; vz: from 4; vr: from 5; vp: from 6; va: from 7",
     "2: from vx; 3: from vy; 4: from vz; 5: from vr; 6: from vp; 7: from va"},
    {"ObjectAccelerationData", 7, "TimedAcceleration3D",
     "ax: from 2; ay: from 3; az: from 4; drop 5; drop 6; drop 7",
     "2: from ax; 3: from ay; 4: from az; 5: default 0; 6: default 0; 7: default 0"},
    {"AccelerationSensorData", 4, "TimedAcceleration3D", "ax: from 2; ay: from 3; az: from 4",
     "2: from ax; 3: from ay; 4: from az"},
    {"GyroSensorData", 7, "TimedOrientation3D", "r: from 2; p: from 3; y: from 4; drop 5; drop 6; drop 7",
     "2: from r; 3: from p; 4: from y; 5: default 0; 6: default 0; 7: default 0"},
    {"GyroSensorData", 7, "TimedAngularVelocity3D",
     "avx: from 5; avy: from 6; avz: from 7; drop 2; drop 3; drop 4",
     "5: from avx; 6: from avy; 7: from avz; 2: default 0; 3: default 0; 4: default 0"},
    {"ImuData", 10, "TimedAngularVelocity3D",
     "avx: from 2; avy: from 3; avz: from 4; drop 5; drop 6; drop 7; drop 8; drop 9; drop 10",
     "2: from avx; 3: from avy; 4: from avz; 5: default 0; 6: default 0; 7: default 0; 8: default 0; 9: "
     "default 0; 10: default 0"},
    {"ImuData", 10, "TimedAcceleration3D",
     "ax: from 5; ay: from 6; az: from 7; drop 2; drop 3; drop 4; drop 8; drop 9; drop 10",
     "5: from ax; 6: from ay; 7: from az; 2: default 0; 3: default 0; 4: default 0; 8: default 0; 9: default "
     "0; 10: default 0"},
    {"ImuData", 10, "TimedOrientation3D",
     "r: from 8; p: from 9; y: from 10; drop 2; drop 3; drop 4; drop 5; drop 6; drop 7",
     "8: from r; 9: from p; 10: from y; 2: default 0; 3: default 0; 4: default 0; 5: default 0; 6: default "
     "0; 7: default 0"},
    {"GpsData", 5, "GPSData", gps_v2_to_rtm, gps_v2_to_opros},
    {"Float64Array", 2, "RangeData", "ranges: from 2; geometry: default 0; config: default 0",
     "2: from ranges; drop geometry; drop config"},
    {"Float64Array", 2, "TimedDoubleSeq", "1: from 2", "2: from 1"},
};

template <std::size_t count>
const DeviceConversion* find(const DeviceConversion (&conversions)[count], std::string_view opros_name,
                             const wire::Type& opros, std::string_view rtm) {
    const std::size_t fields = opros.kind == wire::Kind::structure ? opros.children.size() : 0;
    for (const auto& each : conversions)
        if (each.opros == opros_name && (each.fields == 0 || each.fields == fields) && each.rtm == rtm)
            return &each;
    return nullptr;
}

} // namespace

std::string device_conversion(std::string_view opros_name, const wire::Type& opros, std::string_view rtm_type,
                              bool opros_sends) {
    constexpr std::string_view prefix = "IDL:RTC/", suffix = ":1.0";
    if (!rtm_type.starts_with(prefix) || !rtm_type.ends_with(suffix)) return "";
    const auto rtm = rtm_type.substr(prefix.size(), rtm_type.size() - prefix.size() - suffix.size());
    if (const auto* found = find(device_conversions, opros_name, opros, rtm))
        return std::string(opros_sends ? found->to_rtm : found->to_opros);
    if (const auto* found = find(device_conversions_v2, opros_name, opros, rtm))
        return std::string(opros_sends ? status_to_rtm : status_to_opros)
            .append(opros_sends ? found->to_rtm : found->to_opros);
    return "";
}

} // namespace tandem::adaptor
