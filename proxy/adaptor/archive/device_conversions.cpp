// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/device_conversions.hpp"

namespace tandem::adaptor {
namespace {

struct DeviceConversion {
    std::string_view opros, rtm, to_rtm, to_opros;
};

// Of a GPS: latitude, longitude, time as a text, velocity.
constexpr std::string_view gps_to_rtm =
    "latitude: from 1; longitude: from 2; horizontalSpeed: from 4; drop 3; timeFromGPS: default 0; altitude: "
    "default "
    "0; horizontalError: default 0; verticalError: default 0; heading: default 0; verticalSpeed: default 0; "
    "numSatellites: default 0; fixType: default 1";
constexpr std::string_view gps_to_opros = "1: from latitude; 2: from longitude; 3: default ; 4: from "
                                          "horizontalSpeed; drop timeFromGPS; drop altitude; "
                                          "drop horizontalError; drop verticalError; drop heading; drop "
                                          "verticalSpeed; drop numSatellites; drop fixType";

// Of a posture, the fields are three turning rates, three accelerations, three angles.
constexpr DeviceConversion device_conversions[] = {
    {"ObjectLocation", "TimedPose2D", "positions", "positions"},
    {"ObjectPosition", "TimedPose3D", "positions", "positions"},
    {"CartesianCoordinate", "TimedPose3D", "positions", "positions"},
    {"WheelControlVelocity", "TimedVelocity2D", "vx: from 1; vy: default 0; va: from 2",
     "1: from vx; 2: from va; drop vy"},
    {"ObjectPosture", "TimedAngularVelocity3D",
     "avx: from 1; avy: from 2; avz: from 3; drop 4; drop 5; drop 6; drop 7; drop 8; drop 9",
     "1: from avx; 2: from avy; 3: from avz; 4: default 0; 5: default 0; 6: default 0; 7: default 0; 8: "
     "default 0; "
     "9: default 0"},
    {"ObjectPosture", "TimedAcceleration3D",
     "ax: from 4; ay: from 5; az: from 6; drop 1; drop 2; drop 3; drop 7; drop 8; drop 9",
     "4: from ax; 5: from ay; 6: from az; 1: default 0; 2: default 0; 3: default 0; 7: default 0; 8: default "
     "0; "
     "9: default 0"},
    {"ObjectPosture", "TimedOrientation3D",
     "r: from 7; p: from 8; y: from 9; drop 1; drop 2; drop 3; drop 4; drop 5; drop 6",
     "7: from r; 8: from p; 9: from y; 1: default 0; 2: default 0; 3: default 0; 4: default 0; 5: default 0; "
     "6: default 0"},
    {"GpsData", "GPSData", gps_to_rtm, gps_to_opros},
    {"GPSData", "GPSData", gps_to_rtm, gps_to_opros},
    {"std::vector<double>", "RangeData", "ranges: from 1; geometry: default 0; config: default 0",
     "1: from ranges; drop geometry; drop config"},
    // The sixth field is the pixels, which have no name in the archive. Most camera RTCs set no bpp, so that only their
    // pixels say how many bytes each has. pictures.hpp checks the rest.
    {"RawImage", "CameraImage",
     "narrow; width: from width; height: from height; bpp: from pixelByte * 8; format: from raw; fDiv: "
     "default 0; "
     "pixels: from 6 first width height pixelByte; drop size",
     "narrow; refuse format jpeg jpg png gif tiff webp h26; raw: default raw; width: from width; "
     "height: from height; pixelByte: count pixels per width height; size: count pixels; 6: from pixels; "
     "drop bpp; drop fDiv"},
};

} // namespace

std::string device_conversion(std::string_view opros_type, std::string_view rtm_type, bool opros_sends) {
    constexpr std::string_view prefix = "IDL:RTC/", suffix = ":1.0";
    if (!rtm_type.starts_with(prefix) || !rtm_type.ends_with(suffix)) return "";
    rtm_type = rtm_type.substr(prefix.size(), rtm_type.size() - prefix.size() - suffix.size());
    for (const auto& each : device_conversions)
        if (each.opros == opros_type && each.rtm == rtm_type)
            return std::string(opros_sends ? each.to_rtm : each.to_opros);
    return "";
}

} // namespace tandem::adaptor
