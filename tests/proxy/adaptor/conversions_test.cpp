// SPDX-License-Identifier: Apache-2.0
// The conversions that a link asks for, through the mirrors of data ports, and the device types.
#include "proxy/adaptor/archive/device_conversions.hpp"
#include "proxy/wire/time.hpp"
#include "tests/proxy/adaptor/peer_ports.hpp"
#include "tests/support/allocations.hpp"

#include <ApiTypes.h>
#include <RawImage.h>

#include <catch2/catch.hpp>

#include <numbers>

using namespace tandem;
using adaptor::test::content;
using adaptor::test::Wire;

TEST_CASE("a port widens, converts units and refuses what its request does not cover") {
    Wire wire("convert", "IDL:T:1.0", "{tm}({sec}u{nsec}u){angle}d{label}s#8");
    adaptor::MirrorInPort plain(wire.in, wire.own.link.writer("in"));
    opros_any number(1.5F);
    CHECK_FALSE(plain.checkType(number));
    CHECK_THAT(plain.typeError(), Catch::Contains("'in'") && Catch::Contains("'f'") &&
                                      Catch::Contains("'(uu)ds#8'") && Catch::Contains("convert.in"));
    adaptor::MirrorInPort input(wire.in, wire.own.link.writer("in"),
                                "widen; angle: from 1 deg->rad; label: default none");
    REQUIRE(input.checkType(number));
    opros_any degrees(180.0F);
    REQUIRE(input.push(degrees) == OPROS_SUCCESS);
    const auto bytes = wire.received();
    wire::CdrReader in(bytes);
    CHECK(in.get<double>() == Approx(std::numbers::pi));
    CHECK(in.get_string() == "none");

    adaptor::MirrorInPort nonsense(wire.in, wire.own.link.writer("in"), "bigger");
    CHECK_FALSE(nonsense.checkType(number));
    CHECK_THAT(nonsense.typeError(), Catch::Contains("'bigger'"));
    CHECK_FALSE(nonsense.first_refusal().empty());
}

namespace {

/// Counts how often it is encoded.
struct Scan {
    std::vector<float> ranges;
    static inline int encoded = 0;
    void save(opros::archive::oarchive& ar, const unsigned int) {
        ++encoded;
        ar << ranges;
    }
    void load(opros::archive::iarchive& ar, const unsigned int) { ar >> ranges; }
};

/// Sends and receives values through converting ports, and returns the allocations of the last message.
template <class T>
std::pair<long, long> converted_allocations(const std::string& what, const std::string& signature, T& value) {
    Wire wire(what, "IDL:T:1.0", signature);
    adaptor::MirrorInPort input(wire.in, wire.own.link.writer("in"), "widen");
    opros_any any(value);
    REQUIRE(input.checkType(any));
    InputDataPort<T> target(OPROS_FIFO, 4);
    adaptor::MirrorOutPort output(
        wire.out, wire.own.link.reader("out"), [](DataPortListener*) {}, "narrow");
    REQUIRE(output.checkType(&target));
    std::pair<long, long> counted;
    opros_any received{T(value)};
    for (int i = 0; i < 5; ++i) {
        long before = allocations();
        REQUIRE(input.push(any) == OPROS_SUCCESS);
        counted.first = allocations() - before;
        wire.send(wire.received());
        before = allocations();
        delete target.pop();
        counted.second = allocations() - before;
    }
    return counted;
}

} // namespace

TEST_CASE("a converted message of a fixed size is sent and received without an allocation") {
    float value = 1.5F;
    CHECK(converted_allocations("fixed", "d", value) == std::pair(0L, 0L));
}

TEST_CASE("a converted message is encoded and converted once, whether short or too long for the ring") {
    Scan scan;
    scan.ranges.assign(GENERATE(10, 500'000), 1.5F);
    Wire wire("scan", "IDL:T:1.0", "ad");
    adaptor::MirrorInPort input(wire.in, wire.own.link.writer("in"), "widen");
    opros_any any(scan);
    REQUIRE(input.checkType(any));
    Scan::encoded = 0;
    for (int i = 1; i <= 5; ++i) {
        REQUIRE(input.push(any) == OPROS_SUCCESS);
        CHECK(Scan::encoded == i);
        const auto bytes = wire.received();
        CHECK(bytes.size() == 8 + 8 * scan.ranges.size());
        CHECK(wire::CdrReader(bytes).get_count(8) == scan.ranges.size());
    }
    // Another length than the one before.
    scan.ranges.resize(scan.ranges.size() / 2, 2.5F);
    opros_any shorter(scan);
    REQUIRE(input.push(shorter) == OPROS_SUCCESS);
    CHECK(wire.received().size() == 8 + 8 * scan.ranges.size());
}

TEST_CASE("a value beyond the bound of the peer's type is counted as dropped, and those before and after it "
          "cross") {
    Wire wire("bound", "IDL:T:1.0", "{label}s#8");
    adaptor::MirrorInPort input(wire.in, wire.own.link.writer("in"));
    opros_any sample{std::string()};
    REQUIRE(input.checkType(sample));
    for (const std::string text : {"short", "much too long", "also fine"}) {
        opros_any value(text);
        CHECK(input.push(value) == (text.size() <= 8 ? OPROS_SUCCESS : OPROS_BAD_INPUT_PARAMETER));
    }
    const auto counters = wire.peer.link.reader("in").counters();
    CHECK(counters.sent == 3);
    CHECK(counters.refused == 2);
}

TEST_CASE("ports of several types push into one port of the peer") {
    Wire wire("many-to-one", "IDL:T:1.0", "ad");
    adaptor::MirrorInPort input(wire.in, wire.own.link.writer("in"));
    opros_any vector(std::vector<double>{1, 2}), valarray(std::valarray<double>{3});
    REQUIRE(input.checkType(vector));
    REQUIRE(input.checkType(valarray));
    CHECK(input.push(vector) == OPROS_SUCCESS);
    CHECK(input.push(valarray) == OPROS_SUCCESS);
    CHECK(wire::CdrReader(wire.received()).get_count(8) == 2);
    CHECK(wire::CdrReader(wire.received()).get_count(8) == 1);
}

TEST_CASE("several ports read what one port of the peer sends, each all of it in its own time") {
    Wire wire("one-to-many", "IDL:T:1.0", "d");
    adaptor::MirrorOutPort output(wire.out, wire.own.link.reader("out"), [](DataPortListener*) {});
    InputDataPort<double> fifo(OPROS_UFIFO, 4), last(OPROS_LAST, 1), late(OPROS_UFIFO, 4);
    for (auto* target : {&fifo, &last, &late}) REQUIRE(output.checkType(target));
    std::vector<std::byte> bytes;
    for (int i = 0; i < 40; ++i) {
        wire::CdrWriter(bytes).put(static_cast<double>(i));
        wire.send(bytes);
        if (i % 3 != 0) continue;
        while (const std::unique_ptr<opros_any> value{fifo.pop()}) continue;
    }
    CHECK(content<double>(std::unique_ptr<opros_any>(last.pop())) == 39);
    for (int i = 0; i < 40; ++i) CHECK(content<double>(std::unique_ptr<opros_any>(late.pop())) == i);
    CHECK_FALSE(std::unique_ptr<opros_any>(late.pop()));
    output.clearConnection();
}

TEST_CASE("device types are converted to their counterparts and back by default") {
    const std::string tm = "{tm}({sec}u{nsec}u)", point = "({x}d{y}d)";
    {
        Wire wire("pose", "IDL:RTC/TimedPose2D:1.0", tm + "{data}({position}" + point + "{heading}d)");
        const auto back = wire.there_and_back(ObjectLocation(1, 2, 3));
        CHECK(content<ObjectLocation>(back).theta == 3);
        CHECK(content<ObjectLocation>(back).y == 2);
    }
    {
        Wire wire("pose3", "IDL:RTC/TimedPose3D:1.0",
                  tm + "{data}({position}({x}d{y}d{z}d){orientation}({r}d{p}d{y}d))");
        CHECK(content<ObjectPosition>(wire.there_and_back(ObjectPosition(1, 2, 3, 4, 5, 6))).yaw == 6);
        CHECK(content<CartesianCoordinate>(wire.there_and_back(CartesianCoordinate(1, 2, 3, 4, 5, 6))).z ==
              3);
    }
    {
        Wire wire("velocity", "IDL:RTC/TimedVelocity2D:1.0", tm + "{data}({vx}d{vy}d{va}d)");
        WheelControlVelocity velocity;
        velocity.forward = 0.5;
        velocity.angular = -1;
        const auto back = wire.there_and_back(velocity);
        CHECK(content<WheelControlVelocity>(back).forward == 0.5);
        CHECK(content<WheelControlVelocity>(back).angular == -1);
    }
    {
        Wire wire("gps", "IDL:RTC/GPSData:1.0",
                  tm + "{timeFromGPS}({sec}u{msec}u){latitude}d{longitude}d{altitude}d{horizontalError}d{"
                       "verticalError}d"
                       "{heading}d{horizontalSpeed}d{verticalSpeed}d{numSatellites}q{fixType}e#3");
        GpsData gps;
        gps.latitude = 36.3;
        gps.velocity = 2;
        const auto back = wire.there_and_back(gps);
        CHECK(content<GpsData>(back).latitude == 36.3);
        CHECK(content<GpsData>(back).velocity == 2);
    }
    for (const auto& [type, members, first] :
         {std::tuple{"TimedAngularVelocity3D", "{avx}d{avy}d{avz}d", 1.0},
          {"TimedAcceleration3D", "{ax}d{ay}d{az}d", 4.0},
          {"TimedOrientation3D", "{r}d{p}d{y}d", 7.0}}) {
        Wire wire(std::string("posture") + type, "IDL:RTC/" + std::string(type) + ":1.0",
                  tm + "{data}(" + members + ")");
        ObjectPosture posture;
        posture.pRate = 1;
        posture.xAcceleration = 4;
        posture.roll = 7;
        const auto back = wire.there_and_back(posture);
        const auto& value = content<ObjectPosture>(back);
        CHECK(value.pRate == (first == 1 ? 1 : 0));
        CHECK(value.xAcceleration == (first == 4 ? 4 : 0));
        CHECK(value.roll == (first == 7 ? 7 : 0));
    }
    {
        Wire wire("range", "IDL:RTC/RangeData:1.0",
                  tm + "{ranges}ad{geometry}({geometry}({pose}d){elementGeometries}ad){config}({minAngle}d{"
                       "maxAngle}d)");
        CHECK(content<std::vector<double>>(wire.there_and_back(std::vector<double>{1, 2, 3})).at(2) == 3);
    }
    {
        Wire wire("image", "IDL:RTC/CameraImage:1.0",
                  tm + "{width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay");
        unsigned char pixels[2 * 3 * 3];
        for (std::size_t i = 0; i < sizeof pixels; ++i) pixels[i] = static_cast<unsigned char>(i);
        RawImageData data(pixels, 2, 3, 3);
        const auto back = wire.there_and_back(RawImage(data));
        auto* image = content<RawImage>(back).getImage();
        CHECK(image->getWidth() == 2);
        CHECK(image->getHeight() == 3);
        CHECK(image->getPixelByte() == 3);
        REQUIRE(image->getSize() == sizeof pixels);
        CHECK(std::equal(pixels, pixels + sizeof pixels, image->getData()));
        // The conversion in docs/device_types.md.
        Wire camera(
            "camera", "IDL:Img/TimedCameraImage:1.0",
            tm + "{data}({captured_time}({sec}u{nsec}u){image}({width}i{height}i{format}e#37{raw_data}ay)"
                 "{intrinsic}({matrix_element}[5]d{distortion_coefficient}ad){extrinsic}[4][4]d){error_code}"
                 "i");
        const auto of_camera = camera.there_and_back(
            RawImage(data),
            "narrow; data.image.width: from width; data.image.height: from height; data.image.format: "
            "default 1; data.image.raw_data: from 6 first width height pixelByte; data.captured_time: "
            "default 0; data.intrinsic: default 0; data.extrinsic: default 0; error_code: default 0; drop "
            "raw; drop "
            "size",
            "narrow; refuse data.image.format 3 4; raw: default raw; width: from data.image.width; "
            "height: from data.image.height; pixelByte: count data.image.raw_data per data.image.width "
            "data.image.height; size: count data.image.raw_data; 6: from data.image.raw_data; drop "
            "data.captured_time; drop data.intrinsic; drop data.extrinsic; drop error_code");
        auto* of_rtc = content<RawImage>(of_camera).getImage();
        CHECK(of_rtc->getWidth() == 2);
        REQUIRE(of_rtc->getSize() == sizeof pixels);
        CHECK(std::equal(pixels, pixels + sizeof pixels, of_rtc->getData()));
    }
    const wire::Type image = wire::parse_signature("{raw}s{width}i{height}i{pixelByte}i{size}t{6}ay");
    CHECK_FALSE(adaptor::device_conversion("RawImage", image, "IDL:RTC/CameraImage:1.0", true).empty());
    CHECK(adaptor::device_conversion("RawImage", image, "IDL:RTC/TimedDouble:1.0", true).empty());
    CHECK(adaptor::device_conversion("RawImage", image, "", true).empty());
}
