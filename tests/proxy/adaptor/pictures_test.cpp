// SPDX-License-Identifier: Apache-2.0
// Pictures as components send them, with sizes that contradict the number of bytes.
#include "proxy/adaptor/event/mirror_event_out_port.hpp"
#include "proxy/adaptor/service/mirror_provided_port.hpp"
#include "proxy/adaptor/service/mirror_required_port.hpp"
#include "tests/proxy/adaptor/pictures.hpp"
#include "tests/proxy/adaptor/provided_port_connector.hpp"

#include <ApiTypes.h>
#include <InputEventPort.h>
#include <MethodInvokeException.h>
#include <ProvidedMethod.h>
#include <RawImage.h>
#include <RequiredMethod.h>

#include <catch2/catch.hpp>

using namespace tandem;
using adaptor::test::believing_message;
using adaptor::test::believing_signature;
using adaptor::test::BelievingImage;
using adaptor::test::put_picture;
using adaptor::test::Receiver;
using adaptor::test::Sender;
using adaptor::test::Wire;

namespace {

const std::string camera_signature = "{tm}({sec}u{nsec}u){width}q{height}q{bpp}q{format}s{fDiv}d{pixels}ay";

/// A picture as a camera RTC sends it, except for `bpp`.
struct Camera {
    const char* what;
    std::uint16_t width, height;
    const char* format;
    std::size_t bytes;
    int pixel_bytes; ///< that it arrives with; -1: it is refused
};

// What public camera RTCs send: with OpenCV, of hrpsys and Choreonoid, of simulators, network and depth cameras. Most set
// width, height and pixels only.
constexpr Camera cameras[] = {
    {"colours of OpenCV", 32, 24, "", 32 * 24 * 3, 3},
    {"colours, small", 8, 6, "", 8 * 6 * 3, 3},
    {"grey", 32, 24, "", 32 * 24, 1},
    {"one pixel", 1, 1, "", 3, 3},
    {"one row", 64, 1, "GRAY8", 64, 1},
    {"simulator's bitmap", 32, 24, "bitmap", 32 * 24 * 3, 3},
    {"RGB8", 32, 24, "RGB8", 32 * 24 * 3, 3},
    {"BGR with alpha", 32, 24, "BGRA", 32 * 24 * 4, 4},
    {"YUV 4:2:2", 32, 24, "YUYV", 32 * 24 * 2, 2},
    {"YUV 4:2:0, one and a half bytes a pixel", 32, 24, "I420", 32 * 24 * 3 / 2, -1},
    {"Bayer pattern", 32, 24, "BAYER_GB8", 32 * 24, 1},
    {"depth of 16 bits", 32, 24, "depth", 32 * 24 * 2, 2},
    {"depth as float", 32, 24, "", 32 * 24 * 4, 4},
    {"points, three floats", 32, 24, "", 32 * 24 * 12, 12},
    {"large", 1920, 1080, "", 1920 * 1080 * 3, 3},
    {"largest width", 65535, 1, "", 65535, 1},
    {"black and white, a bit for each pixel", 32, 24, "", 32 * 24 / 8, -1},
    {"rows of a multiple of 4 bytes", 33, 24, "", 100 * 24, -1},
    {"memory of a larger picture before", 16, 12, "", 32 * 24 * 3 + 1, -1},
    {"JPEG", 32, 24, "jpeg", 1021, -1},
    {"JPEG of as many bytes as pixels", 32, 24, "JPEG", 32 * 24, -1},
    {"PNG of as many bytes as pixels", 32, 24, "image/png", 32 * 24 * 2, -1},
    {"JPEG that no format names", 32, 24, "", 1021, -1},
    {"nothing yet", 0, 0, "", 0, 0},
    {"a size and nothing yet", 32, 24, "", 0, -1},
    {"pixels without a size", 0, 0, "", 32 * 24 * 3, -1},
    {"a width without a height", 32, 0, "", 32, -1},
};
constexpr std::uint16_t bits[] = {0, 1, 3, 8, 16, 24, 32, 22015, 65535};

std::vector<std::byte> camera_message(const Camera& camera, std::uint16_t bpp) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    out.put(camera.width);
    out.put(camera.height);
    out.put(bpp);
    out.put_string(camera.format);
    out.put(std::nan(""));
    const std::string pixels(camera.bytes, 'x');
    out.put_sequence(pixels.data(), pixels.size());
    return bytes;
}

} // namespace

TEST_CASE("the picture of a camera RTC arrives with its number of bytes per pixel, or is refused, whatever "
          "its bpp") {
    Wire wire("cameras", "IDL:RTC/CameraImage:1.0", camera_signature);
    Receiver<BelievingImage> believing(wire);
    std::uint64_t refused = 0;
    BelievingImage::overruns = 0;
    for (const Camera& camera : cameras)
        for (const std::uint16_t bpp : bits) {
            INFO(camera.what << ", bpp " << bpp);
            wire.send(camera_message(camera, bpp));
            const auto any = believing.pop();
            refused += camera.pixel_bytes < 0;
            REQUIRE((any != nullptr) == (camera.pixel_bytes >= 0));
            if (!any) continue;
            const auto& image = *opros_any_cast<BelievingImage>(any.get());
            CHECK(image.width == camera.width);
            CHECK(image.height == camera.height);
            CHECK(image.pixelByte == camera.pixel_bytes);
            CHECK(image.size == camera.bytes);
            CHECK(image.pixels == std::vector<char>(camera.bytes, 'x'));
        }
    CHECK(BelievingImage::overruns == 0);
    CHECK(wire.own.link.reader("out").counters().undecodable == refused);
    CHECK(refused > 0);
}

TEST_CASE("a picture of each size goes to an RTC and back, and has bpp for its bytes per pixel") {
    Wire wire("pictures", "IDL:RTC/CameraImage:1.0", camera_signature);
    Sender<RawImage> sender(wire);
    Receiver<RawImage> receiver(wire);
    for (const Camera& camera : cameras) {
        if (camera.pixel_bytes < 0) continue;
        INFO(camera.what);
        RawImageData data(camera.width, camera.height, camera.pixel_bytes);
        REQUIRE(sender.push(RawImage(data)));
        auto bytes = wire.received();
        wire::CdrReader in(bytes);
        CHECK(in.get<std::uint16_t>() == camera.width);
        CHECK(in.get<std::uint16_t>() == camera.height);
        CHECK(in.get<std::uint16_t>() == 8 * camera.pixel_bytes);
        in.get_string();
        in.get<double>();
        CHECK(in.get_count(1) == camera.bytes);
        for (const std::uint16_t bpp : bits) { // an RTC that copies what it has to copy
            std::memcpy(bytes.data() + 2 * sizeof bpp, &bpp, sizeof bpp);
            wire.send(bytes);
            const auto back = receiver.pop();
            REQUIRE(back);
            RawImageData& image = *opros_any_cast<RawImage>(back.get())->getImage();
            CHECK(image.getPixelByte() == camera.pixel_bytes);
            CHECK(image.getSize() == camera.bytes);
        }
    }
    CHECK(wire.own.link.reader("out").counters().undecodable == 0);
}

TEST_CASE(
    "a component's picture that has too few bytes for its size is refused, and one in longer memory has "
    "its bytes only") {
    Wire wire("sent-pictures", "IDL:RTC/CameraImage:1.0", camera_signature);
    Sender<BelievingImage> sender(wire);
    std::uint64_t refused = 0;
    for (const Camera& camera : cameras)
        for (const int pixel_bytes : {-1, 0, 1, 2, 3, 4, 12, 64, 65, 2752, std::numeric_limits<int>::max()}) {
            INFO(camera.what << ", pixelByte " << pixel_bytes);
            const auto pixels = std::size_t{camera.width} * camera.height;
            const bool fits = pixel_bytes >= 0 && pixel_bytes <= 64 && (pixel_bytes > 0 || pixels == 0) &&
                              pixels * static_cast<std::size_t>(pixel_bytes) <= camera.bytes;
            refused += !fits;
            REQUIRE(sender.push(BelievingImage::of(camera.width, camera.height, pixel_bytes, camera.bytes)) ==
                    fits);
            const auto bytes = wire.received();
            if (!fits) continue;
            wire::CdrReader in(bytes);
            in.get<std::uint16_t>();
            in.get<std::uint16_t>();
            CHECK(in.get<std::uint16_t>() == 8 * pixel_bytes);
            in.get_string();
            in.get<double>();
            CHECK(in.get_count(1) == pixels * static_cast<std::size_t>(pixel_bytes));
        }
    for (const auto& [width, height] : {std::pair(-32, 24), {-32, -24}, {70000, 1}, {1 << 30, 1 << 30}}) {
        ++refused;
        CHECK_FALSE(sender.push(BelievingImage::of(width, height, 1, 70000)));
        ++refused;
        CHECK_FALSE(sender.push(BelievingImage::of(width, height, 16, 0)));
    }
    CHECK(wire.peer.link.reader("in").counters().refused == refused);
}

TEST_CASE("a picture that an RTC sends as the component's own structure is refused if its sizes and bytes "
          "contradict each other") {
    const bool in_list = GENERATE(false, true);
    Wire wire(in_list ? "listed-pictures" : "own-pictures", "IDL:M/Picture:1.0",
              in_list ? "a(" + believing_signature + ")" : believing_signature);
    std::unique_ptr<Receiver<BelievingImage>> one;
    std::unique_ptr<Receiver<std::vector<BelievingImage>>> list;
    if (in_list)
        list = std::make_unique<Receiver<std::vector<BelievingImage>>>(wire);
    else
        one = std::make_unique<Receiver<BelievingImage>>(wire);
    struct Case {
        int width, height, pixel_byte;
        unsigned long size;
        std::size_t bytes;
        bool fits;
    };
    std::uint64_t refused = 0;
    BelievingImage::overruns = 0;
    for (const auto& [width, height, pixel_byte, size, bytes, fits] :
         {Case{4, 3, 3, 36, 36, true}, Case{0, 0, 0, 0, 0, true}, Case{4, 3, 0, 36, 36, false},
          Case{4, 3, 3, 40, 36, false}, Case{4, 3, 3, 36, 35, false}, Case{4, 3, 3, 36, 37, false},
          Case{-4, -3, 3, 36, 36, false}, Case{1 << 30, 1 << 30, 16, 0, 0, false},
          Case{1 << 16, 1 << 16, 1, 0, 0, false}, Case{1, 1, 100, 100, 100, false},
          Case{4, 3, 3, ~0ul, 36, false}}) {
        INFO(width << " x " << height << " x " << pixel_byte << ", size " << size << ", bytes " << bytes);
        const BelievingImage image{width, height, pixel_byte, size, std::vector<char>(bytes, 'x')};
        auto message = believing_message(image);
        if (in_list) { // behind one that fits
            message.clear();
            wire::CdrWriter out(message);
            out.put(std::uint32_t{2});
            for (const auto& each : {BelievingImage::of(1, 1, 1, 1), image}) put_picture(each, out);
        }
        wire.send(message);
        refused += !fits;
        CHECK((in_list ? list->pop() != nullptr : one->pop() != nullptr) == fits);
    }
    CHECK(BelievingImage::overruns == 0);
    CHECK(wire.own.link.reader("out").counters().undecodable == refused);
}

TEST_CASE("pictures of Img::TimedCameraImage cross as a port requests: grey, colour and uncompressed") {
    // The conversion in docs/device_types.md.
    const std::string to_opros =
        "narrow; refuse data.image.format 3 4; raw: default raw; width: from data.image.width; "
        "height: from data.image.height; "
        "pixelByte: count data.image.raw_data per data.image.width data.image.height; "
        "size: count data.image.raw_data; 6: from data.image.raw_data; drop data.captured_time; "
        "drop data.intrinsic; drop data.extrinsic; drop error_code";
    const bool computed = GENERATE(true, false);
    Wire wire(computed ? "img" : "img3", "IDL:Img/TimedCameraImage:1.0",
              "{tm}({sec}u{nsec}u){data}({captured_time}({sec}u{nsec}u){image}({width}i{height}i{format}e#37{"
              "raw_data}ay){intrinsic}({matrix_element}[5]d{distortion_coefficient}ad){extrinsic}[4][4]d){"
              "error_code}i");
    // A size of 3 bytes per pixel is accepted only if it is correct.
    Receiver<BelievingImage> receiver(
        wire, computed ? to_opros
                       : "narrow; raw: default raw; width: from data.image.width; "
                         "height: from data.image.height; pixelByte: default 3; "
                         "size: count data.image.raw_data; 6: from data.image.raw_data; "
                         "drop data.captured_time; drop data.image.format; drop data.intrinsic; drop "
                         "data.extrinsic; drop error_code");
    BelievingImage::overruns = 0;
    struct Case {
        std::int32_t width, height;
        std::uint32_t format;
        std::size_t bytes;
        int pixel_bytes;
    };
    std::uint64_t refused = 0;
    for (const auto& [width, height, format, bytes, pixel_bytes] :
         {Case{32, 24, 1, 32 * 24 * 3, 3}, Case{32, 24, 2, 32 * 24, 1}, Case{32, 24, 1, 32 * 24, 1},
          Case{32, 24, 5, 32 * 24 * 2, 2}, Case{32, 24, 3, 1021, -1}, Case{32, 24, 4, 32 * 24 * 3, -1},
          Case{-32, 24, 1, 32 * 24 * 3, -1}, Case{-32, -24, 1, 32 * 24 * 3, -1}, Case{0, 24, 1, 100, -1},
          Case{1 << 30, 1 << 30, 1, 100, -1}}) {
        INFO(width << " x " << height << ", format " << format << ", " << bytes);
        std::vector<std::byte> message;
        wire::CdrWriter out(message);
        for (int i = 0; i < 2; ++i) out.put(std::uint32_t{0}); // captured_time
        out.put(width);
        out.put(height);
        out.put(format);
        const std::string pixels(bytes, 'x');
        out.put_sequence(pixels.data(), pixels.size());
        for (int i = 0; i < 5; ++i) out.put(0.0);
        out.put(std::uint32_t{0});
        for (int i = 0; i < 16; ++i) out.put(0.0);
        out.put(std::int32_t{0});
        wire.send(message);
        const auto any = receiver.pop();
        const bool fits = computed ? pixel_bytes > 0 : bytes == 32 * 24 * 3 && width > 0;
        refused += !fits;
        REQUIRE((any != nullptr) == fits);
        if (any) CHECK(opros_any_cast<BelievingImage>(any.get())->pixelByte == (computed ? pixel_bytes : 3));
    }
    CHECK(BelievingImage::overruns == 0);
    CHECK(wire.own.link.reader("out").counters().undecodable == refused);
}

namespace {

/// Keeps what an event port delivers.
struct KeptEvents final : IEventPortLink {
    ReturnType push(Event*) override {
        ++count;
        return OPROS_SUCCESS;
    }
    ReturnType setSource(EventPort*) override { return OPROS_SUCCESS; }
    ReturnType addDestination(EventPort*) override { return OPROS_SUCCESS; }
    ReturnType removeDestination(EventPort*) override { return OPROS_SUCCESS; }
    ReturnType addDestination(RemoteEventPort*) override { return OPROS_SUCCESS; }
    ReturnType removeDestination(RemoteEventPort*) override { return OPROS_SUCCESS; }
    ReturnType clearDestination() override { return OPROS_SUCCESS; }
    ReturnType clearSource() override { return OPROS_SUCCESS; }
    int count = 0;
};

struct Eye {
    int show(BelievingImage image) { return image.pixelByte; }
};
struct EyeProvided : ProvidedServicePort {
    explicit EyeProvided(Eye& eye) { addMethod("show", makeProvidedMethod(&Eye::show, &eye, "show")); }
};
struct EyeRequired : RequiredServicePort {
    EyeRequired() { addMethod("look", makeRequiredMethod(&EyeRequired::look, "look")); }
    BelievingImage look(int eye) {
        return (*reinterpret_cast<RequiredMethod<BelievingImage>*>(getMethod("look")))(eye);
    }
};

const BelievingImage fitting{4, 3, 3, 36, std::vector<char>(36, 'x')},
    contradicting{4, 3, 1, 36, std::vector<char>(36, 'x')};

} // namespace

TEST_CASE("an event whose picture contradicts itself is counted as undecodable") {
    Wire wire("picture-event", "IDL:M/Seen:1.0", "{id}s{picture}(" + believing_signature + ")");
    DataPortListener* listener = nullptr;
    adaptor::MirrorEventOutPort output(wire.out, wire.own.link.reader("out"),
                                       [&](DataPortListener* given) { listener = given; });
    InputEventPort<BelievingImage> target;
    INFO(output.typeError());
    REQUIRE(output.checkType(static_cast<EventPort*>(&target)));
    REQUIRE(target.checkType(static_cast<EventPort*>(&output)));
    KeptEvents kept;
    output.addConnection(&kept);
    REQUIRE(listener);
    BelievingImage::overruns = 0;
    for (const auto* image : {&fitting, &contradicting, &fitting}) {
        std::vector<std::byte> message;
        wire::CdrWriter out(message);
        out.put_string("seen");
        put_picture(*image, out);
        wire.send(message);
    }
    listener->arrived();
    CHECK(kept.count == 2);
    CHECK(BelievingImage::overruns == 0);
    CHECK(wire.own.link.reader("out").counters().undecodable == 1);
    output.removeConnection(&kept);
}

TEST_CASE("a call whose argument or result is a picture that contradicts itself fails with the numbers") {
    const std::string picture = "(" + wire::to_signature(wire::parse_signature(believing_signature)) + ")";
    adaptor::MirrorRequiredPort eye_of_rtc(
        {link::PortKind::service_required, "eye", "Eye", "", "", {{"show", picture + ":i"}}});
    Eye eye;
    EyeProvided provided(eye);
    REQUIRE(eye_of_rtc.bindProvided(&provided) == "");
    BelievingImage::overruns = 0;
    CHECK(eye_of_rtc.serve({"eye", "show", picture + ":i", believing_message(fitting)}).status ==
          link::CallStatus::ok);
    const auto refused = eye_of_rtc.serve({"eye", "show", picture + ":i", believing_message(contradicting)});
    CHECK(refused.status == link::CallStatus::bad_arguments);
    CHECK_THAT(refused.text(), Catch::Contains("4 x 3 pixels of 1 bytes has 36 bytes"));

    const auto name = link::test::unique_name("picture-call");
    const auto here = link::test::adaptor(name), peer = link::test::interceptor(name);
    adaptor::MirrorProvidedPort mirror(
        {link::PortKind::service_provided, "eye", "Eye", "", "eye", {{"look", "i:" + picture}}}, here->link,
        std::chrono::seconds(5));
    ProvidedPortConnector connector(mirror);
    here->link.open();
    peer->link.open();
    here->link.wait_until_up(link::test::soon, "peer");
    EyeRequired required;
    for (auto at = required.getFirst(); at != required.getEnd(); ++at) {
        REQUIRE(mirror.bindMethod(at->second) == "");
        static_cast<RequiredMethodInterface&>(*at->second).Connect(&connector);
    }
    peer->on_call = [](const link::Request& request) {
        const bool first = wire::CdrReader(request.arguments).get<std::int32_t>() == 1;
        return link::Reply{link::CallStatus::ok, believing_message(first ? fitting : contradicting)};
    };
    CHECK(required.look(1).pixelByte == 3);
    CHECK_THROWS_WITH(required.look(2),
                      Catch::Contains("eye.look") && Catch::Contains("4 x 3 pixels of 1 bytes has 36 bytes"));
    CHECK(BelievingImage::overruns == 0);
}
