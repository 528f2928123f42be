// SPDX-License-Identifier: Apache-2.0
// Any messages and values of the device types, through the mirrors of data ports.
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/device_conversions.hpp"
#include "tests/proxy/adaptor/pictures.hpp"
#include "tests/support/stress.hpp"

#include <AccelerationSensorData.h>
#include <ApiTypes.h>
#include <GpsData.h>
#include <GyroSensorData.h>
#include <ImuData.h>
#include <MobileAccelerationData.h>
#include <MobilePositionData.h>
#include <MobileVelocityData.h>
#include <ObjectAccelerationData.h>
#include <ObjectPositionData.h>
#include <ObjectVelocityData.h>
#include <OprosDevice.h>
#include <RawImage.h>

#include <catch2/catch.hpp>

#include <random>
#include <string>
#include <vector>

using namespace tandem;
using adaptor::test::BelievingImage;
using adaptor::test::Receiver;
using adaptor::test::Sender;
using adaptor::test::Wire;
using test::stress;

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

/// A message of the type: numbers of all kinds, sequences of any length, sometimes as many bytes as the pixels need.
void put_any_value(const wire::Type& type, Random& random, wire::CdrWriter& out) {
    using wire::Kind;
    // The last ones are doubles: not a number, infinite, minus zero.
    static constexpr std::uint64_t numbers[] = {
        0, 1, 2, 3, 4, 8, 16, 24, 32, 200, 0x7fffffff, ~0ull, 0x7ffull << 52, 0xfffull << 52, 1ull << 63};
    switch (type.kind) {
    case Kind::structure:
        for (const auto& member : type.children) put_any_value(member, random, out);
        return;
    case Kind::sequence: {
        const std::size_t count = below(random, 2) == 0 ? below(random, 5) * 12 : below(random, 200);
        out.put(static_cast<std::uint32_t>(count));
        for (std::size_t i = 0; i < count; ++i) put_any_value(type.children.front(), random, out);
        return;
    }
    case Kind::string:
        out.put_string(below(random, 4) == 0 ? "jpeg" : std::string(below(random, 4), 'r'));
        return;
    default:
        break;
    }
    const std::uint64_t number =
        below(random, 4) == 0 ? random() * 0x100000001ull : numbers[below(random, std::size(numbers))];
    const std::size_t size = wire::primitive_size(type.kind);
    out.put_block(&number, size, size);
}

/// The bytes of each field of a message, without nesting; a sequence is one field.
void add_fields(const wire::Type& type, wire::CdrReader& in, std::vector<std::string>& fields) {
    using wire::Kind;
    const auto text = [](std::span<const std::byte> bytes) {
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    if (type.kind == Kind::structure)
        for (const auto& member : type.children) add_fields(member, in, fields);
    else if (type.kind == Kind::string)
        fields.emplace_back(in.get_string());
    else if (type.kind == Kind::sequence && type.children.front().kind == Kind::structure) {
        std::vector<std::string> elements;
        for (auto count = in.get_count(1); count > 0 && in.ok(); --count)
            add_fields(type.children.front(), in, elements);
        fields.emplace_back(elements.size(), 'e');
    } else if (type.kind == Kind::sequence) {
        const std::size_t size = wire::primitive_size(type.children.front().kind);
        fields.push_back(text(in.get_sequence(size, size)));
    } else {
        const std::size_t size = wire::primitive_size(type.kind);
        fields.push_back(text(in.get_block(size, size)));
    }
}

std::vector<std::string> fields_of(const std::string& signature, const std::vector<std::byte>& message) {
    std::vector<std::string> fields;
    wire::CdrReader in(message);
    add_fields(wire::parse_signature("(" + signature + ")"), in, fields);
    REQUIRE(in.ok());
    return fields;
}

template <class T>
std::vector<std::byte> encoded(const T& value) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    adaptor::CdrOarchive archive(out);
    T copy(value);
    archive << copy;
    return bytes;
}

std::vector<std::byte> any_message(const std::string& signature, Random& random) {
    std::vector<std::byte> message;
    wire::CdrWriter out(message);
    put_any_value(wire::parse_signature("(" + signature + ")"), random, out);
    return message;
}

std::string bytes_of(std::uint32_t number) {
    return std::string(reinterpret_cast<const char*>(&number), sizeof number);
}

struct DeviceType {
    const char *rtm, *signature;
    const char* own = ""; ///< the OPRoS type's signature
    std::vector<std::pair<std::size_t, std::size_t>>
        fields{}; ///< of the RTM and of the OPRoS type that correspond
    bool has_status() const { return own[0] == 'u'; }
};

/// Fields without a counterpart are 0, except OPROS_SUCCESS and GPS_FIX_NORMAL.
bool is_default(const DeviceType& device, bool opros, std::size_t index, const std::string& field) {
    if (opros && device.has_status() && index == 0) return field == bytes_of(OPROS_SUCCESS);
    if (!opros && std::string(device.rtm) == "GPSData" && index == 11) return field == bytes_of(1);
    return field.find_first_not_of('\0') == std::string::npos;
}

/// Compares a converted message with its source: the fields that correspond have equal bytes, the others their defaults.
void check_fields(const DeviceType& device, bool to_opros, const std::vector<std::string>& source,
                  const std::vector<std::string>& made) {
    std::vector<bool> converted(made.size());
    std::size_t wrong = 0;
    for (const auto& [rtm, opros] : device.fields) {
        wrong += made.at(to_opros ? opros : rtm) != source.at(to_opros ? rtm : opros);
        converted[to_opros ? opros : rtm] = true;
    }
    for (std::size_t i = 0; i < made.size(); ++i)
        wrong += !converted[i] && !is_default(device, to_opros, i, made[i]);
    REQUIRE(wrong == 0);
}

/// Sends messages of the RTM type, whole, cut and with changed bytes, and the values that came back.
template <class T>
void exchange_any_messages(const DeviceType& device, Wire& wire, Random& random) {
    Receiver<T> receiver(wire);
    Sender<T> sender(wire);
    std::uint64_t arrived = 0, returned = 0, refused = 0;
    const int messages = stress(400, 100'000);
    for (int i = 0; i < messages; ++i) {
        std::vector<std::byte> message = any_message(device.signature, random);
        const bool damaged = below(random, 4) == 0;
        if (damaged) message[below(random, message.size())] = static_cast<std::byte>(random());
        const bool cut = below(random, 8) == 0;
        if (cut) message.resize(below(random, message.size()) + 1);
        wire.send(message);
        const auto any = receiver.pop();
        if (!any) continue;
        ++arrived;
        const T& value = *opros_any_cast<T>(any.get());
        if (!damaged && !cut && !device.fields.empty())
            check_fields(device, true, fields_of(device.signature, message),
                         fields_of(device.own, encoded(value)));
        // Sends everything that a component may have, also values that an RTC's type cannot hold.
        (sender.push(value) ? returned : refused)++;
        wire.received();
    }
    CHECK(arrived > 0);
    CHECK(arrived + wire.own.link.reader("out").counters().undecodable ==
          static_cast<std::uint64_t>(messages));
    CHECK(refused == wire.peer.link.reader("in").counters().refused);
    CHECK(returned + refused == arrived);
}

/// Sends values of the OPRoS type: each arrives with equal numbers, or its status says that it is not valid.
template <class T>
void send_any_values(const DeviceType& device, Wire& wire, Random& random) {
    Sender<T> sender(wire);
    std::uint64_t sent = 0;
    for (int i = 0; i < stress(400, 100'000); ++i) {
        const auto bytes = any_message(device.own, random);
        T value;
        adaptor::CdrIarchive archive{wire::CdrReader(bytes)};
        archive >> value;
        const auto own = fields_of(device.own, bytes);
        const bool valid = !device.has_status() || own[0] == bytes_of(API_SUCCESS) ||
                           own[0] == bytes_of(OPROS_SUCCESS) || own[0] == bytes_of(OPROS_SUCCESS_SYNC) ||
                           own[0] == bytes_of(OPROS_VALID_DATA);
        REQUIRE(sender.push(value) == valid);
        if (!valid) continue;
        ++sent;
        check_fields(device, false, own, fields_of(device.signature, wire.received()));
    }
    CHECK(sent > 0);
}

template <class T>
void exchange_all(const DeviceType& device, Random& random) {
    INFO(typeName(static_cast<T*>(nullptr)) << " and " << device.rtm);
    Wire wire(std::string("random-") + device.rtm, std::string("IDL:RTC/") + device.rtm + ":1.0",
              std::string("{tm}({sec}u{nsec}u)") + device.signature);
    exchange_any_messages<T>(device, wire, random);
    if (!device.fields.empty()) send_any_values<T>(device, wire, random);
}

constexpr const char
    *pose2d = "{data}({position}({x}d{y}d){heading}d)",
    *velocity2d = "{data}({vx}d{vy}d{va}d)",
    *pose3d = "{data}({position}({x}d{y}d{z}d){orientation}({r}d{p}d{y}d))",
    *rates = "{data}({avx}d{avy}d{avz}d)", *accelerations = "{data}({ax}d{ay}d{az}d)",
    *angles = "{data}({r}d{p}d{y}d)",
    *gps_data = "{timeFromGPS}({sec}u{msec}u){latitude}d{longitude}d{altitude}d{horizontalError}d{"
                "verticalError}d{heading}d{horizontalSpeed}d{verticalSpeed}d{numSatellites}q{fixType}e#3",
    *range_data = "{ranges}ad{geometry}({geometry}({pose}({position}({x}d{y}d{z}d){orientation}({r}d{p}d{y}"
                  "d)){size}({l}d{w}d{h}d)){elementGeometries}a({pose}({position}({x}d{y}d{z}d){"
                  "orientation}({r}d{p}d{y}d)){size}({l}d{w}d{h}d))){config}({minAngle}d{maxAngle}d{"
                  "angularRes}d{minRange}d{maxRange}d{rangeRes}d{frequency}d)";

} // namespace

TEST_CASE("any message of a device type is a value or is counted as undecodable, and each value is sent or "
          "refused") {
    Random random(44); // the same messages in each run
    BelievingImage::overruns = 0;
    const DeviceType camera{"CameraImage", "{width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay"};
    exchange_all<BelievingImage>(camera, random);
    CHECK(BelievingImage::overruns == 0);
    exchange_all<RawImage>(camera, random);
    exchange_all<ObjectLocation>({"TimedPose2D", pose2d, "ddd", {{0, 0}, {1, 1}, {2, 2}}}, random);
    const DeviceType pose{"TimedPose3D", pose3d, "dddddd", {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}}};
    exchange_all<ObjectPosition>(pose, random);
    exchange_all<CartesianCoordinate>(pose, random);
    exchange_all<WheelControlVelocity>({"TimedVelocity2D", velocity2d, "dd", {{0, 0}, {2, 1}}}, random);
    exchange_all<ObjectPosture>({"TimedAngularVelocity3D", rates, "ddddddddd", {{0, 0}, {1, 1}, {2, 2}}},
                                random);
    exchange_all<ObjectPosture>({"TimedAcceleration3D", accelerations, "ddddddddd", {{0, 3}, {1, 4}, {2, 5}}},
                                random);
    exchange_all<ObjectPosture>({"TimedOrientation3D", angles, "ddddddddd", {{0, 6}, {1, 7}, {2, 8}}},
                                random);
    exchange_all<ObjectRotation>({"TimedOrientation3D", angles, "ddd", {{0, 0}, {1, 1}, {2, 2}}}, random);
    exchange_all<GpsData>({"GPSData", gps_data, "ddsd", {{2, 0}, {3, 1}, {8, 3}}}, random);
    exchange_all<GPSData>({"GPSData", gps_data, "ddsd", {{2, 0}, {3, 1}, {8, 3}}}, random);
    exchange_all<std::vector<double>>({"RangeData", range_data, "ad", {{0, 0}}}, random);
    exchange_all<std::vector<double>>({"TimedDoubleSeq", "{data}ad", "ad", {{0, 0}}}, random);
}

TEST_CASE(
    "any message of a device type of OPRoS v2 has the status OPROS_SUCCESS, and a value with a status of "
    "failure is refused") {
    Random random(45);
    const DeviceType pose{"TimedPose3D", pose3d, "udddddd", {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}}};
    exchange_all<OPRoS::MobilePositionData>({"TimedPose2D", pose2d, "uddd", {{0, 1}, {1, 2}, {2, 3}}},
                                            random);
    exchange_all<OPRoS::MobileVelocityData>({"TimedVelocity2D", velocity2d, "uddd", {{0, 1}, {1, 2}, {2, 3}}},
                                            random);
    exchange_all<OPRoS::MobileAccelerationData>(
        {"TimedAcceleration2D", "{data}({ax}d{ay}d)", "uddd", {{0, 1}, {1, 2}}}, random);
    exchange_all<OPRoS::ObjectPositionData>(pose, random);
    exchange_all<OPRoS::ObjectVelocityData>(
        {"TimedVelocity3D", "{data}({vx}d{vy}d{vz}d{vr}d{vp}d{va}d)", pose.own, pose.fields}, random);
    const DeviceType linear{"TimedAcceleration3D", accelerations, "uddd", {{0, 1}, {1, 2}, {2, 3}}};
    exchange_all<OPRoS::AccelerationSensorData>(linear, random);
    exchange_all<OPRoS::ObjectAccelerationData>({linear.rtm, linear.signature, "udddddd", linear.fields},
                                                random);
    exchange_all<OPRoS::GyroSensorData>({"TimedOrientation3D", angles, "udddddd", linear.fields}, random);
    exchange_all<OPRoS::GyroSensorData>(
        {"TimedAngularVelocity3D", rates, "udddddd", {{0, 4}, {1, 5}, {2, 6}}}, random);
    exchange_all<OPRoS::ImuData>({"TimedAngularVelocity3D", rates, "uddddddddd", {{0, 1}, {1, 2}, {2, 3}}},
                                 random);
    exchange_all<OPRoS::ImuData>(
        {"TimedAcceleration3D", accelerations, "uddddddddd", {{0, 4}, {1, 5}, {2, 6}}}, random);
    exchange_all<OPRoS::ImuData>({"TimedOrientation3D", angles, "uddddddddd", {{0, 7}, {1, 8}, {2, 9}}},
                                 random);
    exchange_all<OPRoS::GpsData>({"GPSData", gps_data, "uddsd", {{2, 1}, {3, 2}, {8, 4}}}, random);
    exchange_all<OPRoS::Float64Array>({"RangeData", range_data, "uad", {{0, 1}}}, random);
    exchange_all<OPRoS::Float64Array>({"TimedDoubleSeq", "{data}ad", "uad", {{0, 1}}}, random);
}
