// SPDX-License-Identifier: Apache-2.0
// Any messages of the device types, through the mirrors of data ports.
#include "proxy/adaptor/archive/device_conversions.hpp"
#include "tests/proxy/adaptor/pictures.hpp"
#include "tests/support/stress.hpp"

#include <ApiTypes.h>
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
    static constexpr std::uint64_t numbers[] = {0, 1, 2, 3, 4, 8, 16, 24, 32, 0x7fffffff, ~0ull};
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
        below(random, 4) == 0 ? random() : numbers[below(random, std::size(numbers))];
    const std::size_t size = wire::primitive_size(type.kind);
    out.put_block(&number, size, size);
}

struct DeviceType {
    const char *rtm, *signature;
};

/// Sends messages of the RTM type, whole, cut and with changed bytes, and the values that came back.
template <class T>
void exchange_any_messages(const DeviceType& device, const std::string& type_name, Random& random) {
    Wire wire(std::string("random-") + device.rtm, std::string("IDL:RTC/") + device.rtm + ":1.0",
              std::string("{tm}({sec}u{nsec}u)") + device.signature);
    REQUIRE_FALSE(adaptor::device_conversion(type_name, wire.out.type, false).empty());
    Receiver<T> receiver(wire);
    Sender<T> sender(wire);
    const wire::Type type = wire::parse_signature(device.signature);
    std::uint64_t arrived = 0, returned = 0, refused = 0;
    const int messages = stress(400, 100'000);
    for (int i = 0; i < messages; ++i) {
        std::vector<std::byte> message;
        wire::CdrWriter out(message);
        put_any_value(type, random, out);
        if (below(random, 4) == 0) message[below(random, message.size())] = static_cast<std::byte>(random());
        if (below(random, 8) == 0) message.resize(below(random, message.size()) + 1);
        wire.send(message);
        const auto any = receiver.pop();
        if (!any) continue;
        ++arrived;
        // What a component may have is sent: also what an RTC's type cannot hold.
        (sender.push(*opros_any_cast<T>(any.get())) ? returned : refused)++;
        wire.received();
    }
    INFO(type_name << " and " << device.rtm);
    CHECK(arrived > 0);
    CHECK(arrived + wire.own.link.reader("out").counters().undecodable ==
          static_cast<std::uint64_t>(messages));
    CHECK(refused == wire.peer.link.reader("in").counters().refused);
    CHECK(returned + refused == arrived);
}

} // namespace

TEST_CASE("any message of a device type is a value or is counted as undecodable, and each value is sent or "
          "refused") {
    Random random(44); // the same messages in each run
    BelievingImage::overruns = 0;
    constexpr DeviceType camera{"CameraImage", "{width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay"};
    exchange_any_messages<BelievingImage>(camera, "RawImage", random);
    CHECK(BelievingImage::overruns == 0);
    exchange_any_messages<RawImage>(camera, "RawImage", random);
    exchange_any_messages<ObjectLocation>({"TimedPose2D", "{data}({position}({x}d{y}d){heading}d)"},
                                          "ObjectLocation", random);
    constexpr DeviceType pose{"TimedPose3D", "{data}({position}({x}d{y}d{z}d){orientation}({r}d{p}d{y}d))"};
    exchange_any_messages<ObjectPosition>(pose, "ObjectPosition", random);
    exchange_any_messages<CartesianCoordinate>(pose, "CartesianCoordinate", random);
    exchange_any_messages<WheelControlVelocity>({"TimedVelocity2D", "{data}({vx}d{vy}d{va}d)"},
                                                "WheelControlVelocity", random);
    exchange_any_messages<ObjectPosture>({"TimedAngularVelocity3D", "{data}({avx}d{avy}d{avz}d)"},
                                         "ObjectPosture", random);
    exchange_any_messages<ObjectPosture>({"TimedAcceleration3D", "{data}({ax}d{ay}d{az}d)"}, "ObjectPosture",
                                         random);
    exchange_any_messages<ObjectPosture>({"TimedOrientation3D", "{data}({r}d{p}d{y}d)"}, "ObjectPosture",
                                         random);
    exchange_any_messages<GpsData>(
        {"GPSData",
         "{timeFromGPS}({sec}u{msec}u){latitude}d{longitude}d{altitude}d{horizontalError}d{"
         "verticalError}d{heading}d{horizontalSpeed}d{verticalSpeed}d{numSatellites}q{fixType}e#3"},
        "GpsData", random);
    exchange_any_messages<std::vector<double>>(
        {"RangeData", "{ranges}ad{geometry}({geometry}({pose}d){elementGeometries}ad){config}({minAngle}d{"
                      "maxAngle}d)"},
        "std::vector<double>", random);
}
