// SPDX-License-Identifier: Apache-2.0
// The bytes and the names under which data types travel, as OpenRTM-aist has them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <rtm/CORBA_CdrMemoryStream.h>
#include <rtm/ConnectorListener.h>
#include <rtm/CorbaNaming.h>
#include <rtm/ext/CameraCommonInterfaceSkel.h>
#include <rtm/ext/ManipulatorCommonInterface_CommonSkel.h>
#include <rtm/ext/ManipulatorCommonInterface_MiddleSkel.h>
#include <rtm/idl/ExtendedFsmServiceSkel.h>

namespace {

using Bytes = std::vector<unsigned char>;

template <class Data>
Bytes bytes_of(const Data& data, bool little_endian = true) {
    int argc = 0;
    static const CORBA::ORB_var orb = CORBA::ORB_init(argc, nullptr); // it brings the code sets of strings
    RTC::CORBA_CdrSerializer<Data> stream;
    stream.isLittleEndian(little_endian);
    REQUIRE(stream.serialize(data));
    Bytes bytes(stream.getDataLength());
    stream.readData(bytes.data(), bytes.size());
    return bytes;
}

/// Returns the bytes with `count` zeros from `at`, because omniORB leaves padding between values uninitialized.
Bytes without_padding(Bytes bytes, std::size_t at, std::size_t count) {
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, Bytes::value_type{0});
    return bytes;
}

template <class Data>
std::size_t size_of_empty() {
    return bytes_of(Data()).size();
}

template <class Data>
std::string id_of() {
    return CORBA_Util::toRepositoryId<Data>();
}

} // namespace

TEST_CASE("A TimedLong travels as seconds and nanoseconds and value in either byte order") {
    RTC::TimedLong data;
    data.tm.sec = 1;
    data.tm.nsec = 0x01020304;
    data.data = -2;
    CHECK(bytes_of(data) == Bytes{1, 0, 0, 0, 4, 3, 2, 1, 0xfe, 0xff, 0xff, 0xff});
    CHECK(bytes_of(data, false) == Bytes{0, 0, 0, 1, 1, 2, 3, 4, 0xff, 0xff, 0xff, 0xfe});
}

TEST_CASE("An interface and a reference to it have the interface's id and name") {
    CHECK(id_of<RTC::RTObject>() == "IDL:omg.org/RTC/RTObject:1.0");
    CHECK(id_of<RTC::RTObject_ptr>() == id_of<RTC::RTObject>());
    CHECK(CORBA_Util::toTypename<RTC::RTObject>() == std::string("RTObject"));
    CHECK(CORBA_Util::toTypename<RTC::RTObject_ptr>() == std::string("RTObject"));
    CHECK(CORBA_Util::toTypename<RTC::TimedLong>() == std::string("TimedLong"));
}

TEST_CASE("A sequence of doubles is aligned after its length") {
    RTC::TimedDoubleSeq data;
    data.tm.sec = data.tm.nsec = 0;
    data.data.length(1);
    data.data[0] = 1.0;
    const Bytes expected{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
    CHECK(without_padding(bytes_of(data), 12, 4) == expected);
}

namespace {

/// Hears values, and adds one element to each.
template <class Data>
struct AddingListener : RTC::ConnectorDataListenerT<Data> {
    using ReturnCode = RTC::ConnectorListenerStatus::Enum;
    using RTC::ConnectorDataListenerT<Data>::operator();
    ReturnCode operator()(RTC::ConnectorInfo&, Data& data) override {
        ++heard;
        last = data;
        data.data.length(data.data.length() + 1);
        data.data[data.data.length() - 1] = 9;
        return RTC::ConnectorListenerStatus::DATA_CHANGED;
    }
    int heard = 0;
    Data last;
};

/// The value that the listener computes from a message.
template <class Data>
Bytes after(AddingListener<Data>& listener, const Bytes& message, bool little_endian) {
    RTC::ByteData bytes;
    bytes.isLittleEndian(little_endian);
    bytes.writeData(message.data(), message.size());
    RTC::ConnectorInfo info("", "", coil::vstring(), coil::Properties());
    listener(info, bytes, "cdr");
    return Bytes(bytes.getBuffer(), bytes.getBuffer() + bytes.getDataLength());
}

/// Behind the count of numbers of 8 bytes.
template <class Data>
Bytes without_padding_of(const Data& data, const Bytes& bytes) {
    return sizeof(*data.data.get_buffer()) == 8 && bytes.size() > 16 ? without_padding(bytes, 12, 4) : bytes;
}

template <class Data>
void check_listener(std::uint32_t length) {
    for (const bool little_endian : {true, false}) {
        AddingListener<Data> listener;
        Data data;
        data.tm.sec = 7;
        data.tm.nsec = 8;
        data.data.length(length);
        for (std::uint32_t i = 0; i < length; ++i) data.data[i] = static_cast<unsigned char>(i + 1);
        const Bytes changed = after(listener, bytes_of(data, little_endian), little_endian);
        CHECK(listener.heard == 1);
        CHECK(without_padding_of(data, bytes_of(listener.last)) == without_padding_of(data, bytes_of(data)));
        data.data.length(length + 1);
        data.data[length] = 9;
        CHECK(without_padding_of(data, changed) == without_padding_of(data, bytes_of(data, little_endian)));
    }
}

} // namespace

TEST_CASE("A listener to values hears numbers of each size in either byte order, and what it changes is "
          "passed on") {
    const std::uint32_t length = GENERATE(0U, 1U, 8U, 1000U);
    check_listener<RTC::TimedOctetSeq>(length);
    check_listener<RTC::TimedShortSeq>(length);
    check_listener<RTC::TimedFloatSeq>(length);
    check_listener<RTC::TimedDoubleSeq>(length);
}

TEST_CASE("A listener to values is not called for bytes that are not a value") {
    RTC::TimedDoubleSeq data;
    data.tm.sec = data.tm.nsec = 0;
    data.data.length(3);
    for (auto i : {0U, 1U, 2U}) data.data[i] = i;
    AddingListener<RTC::TimedDoubleSeq> listener;
    for (const std::size_t size : {0U, 7U, 11U, 16U, 24U, 39U}) {
        Bytes message = bytes_of(data);
        message.resize(size);
        CHECK(after(listener, message, true) == message);
    }
    CHECK(listener.heard == 0);
    after(listener, bytes_of(data), true);
    CHECK(listener.heard == 1);
}

TEST_CASE("A camera image travels as size and format and pixels") {
    RTC::CameraImage image;
    image.tm.sec = image.tm.nsec = 0;
    image.width = 2;
    image.height = 1;
    image.bpp = 8;
    image.format = CORBA::string_dup("g");
    image.fDiv = 0;
    image.pixels.length(2);
    image.pixels[0] = 7;
    image.pixels[1] = 9;
    const Bytes expected{0, 0,   0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 8, 0, 0, 0, 2, 0, 0,
                         0, 'g', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 7, 9};
    CHECK(without_padding(without_padding(bytes_of(image), 14, 2), 22, 2) == expected);
}

TEST_CASE("Types of fixed size have the size of OpenRTM-aist") {
    CHECK(size_of_empty<RTC::TimedState>() == 10);
    CHECK(size_of_empty<RTC::TimedDouble>() == 16);
    CHECK(size_of_empty<RTC::TimedBoolean>() == 9);
    CHECK(size_of_empty<RTC::TimedRGBColour>() == 8 + 3 * 8);
    CHECK(size_of_empty<RTC::TimedPose2D>() == 8 + 3 * 8);
    CHECK(size_of_empty<RTC::TimedCovariance3D>() == 8 + 21 * 8);
    CHECK(size_of_empty<RTC::TimedGeometry3D>() == 8 + 9 * 8);
    CHECK(size_of_empty<RTC::TimedOAP>() == 8 + 9 * 8);
    CHECK(size_of_empty<RTC::TimedQuaternion>() == 8 + 4 * 8);
    CHECK(size_of_empty<RTC::LimbState>() == 8 + 9 * 8 + 4);
    CHECK(size_of_empty<RTC::RangeData>() == 8 + 8 + 9 * 8 + 8 + 7 * 8); // both lists are empty
    CHECK(size_of_empty<RTC::PanTiltState>() == 8 + 8 + 2 * 8 + 2 * 8);
}

TEST_CASE("A camera image of the camera interface has its matrices in it") {
    Img::TimedCameraImage image{};
    // tm, captured_time, width, height, format, no pixels, 5 doubles, no distortion, 16 doubles, error_code
    CHECK(bytes_of(image).size() == 8 + 8 + 12 + 4 + 5 * 8 + 4 + 4 + 16 * 8 + 4);
    image.data.image.format = Img::Y16;
    CHECK(bytes_of(image)[24] == 36);
}

TEST_CASE("Repository ids are those that tools and peers compare") {
    CHECK(id_of<RTC::TimedLong>() == "IDL:RTC/TimedLong:1.0");
    CHECK(id_of<RTC::TimedVelocity2D>() == "IDL:RTC/TimedVelocity2D:1.0");
    CHECK(id_of<RTC::RangeData>() == "IDL:RTC/RangeData:1.0");
    CHECK(id_of<Img::TimedCameraImage>() == "IDL:Img/TimedCameraImage:1.0");
    CHECK(id_of<JARA_ARM::TimedJointPos>() == "IDL:JARA_ARM/TimedJointPos:1.0");
    using Common = JARA_ARM::ManipulatorCommonInterface_Common;
    using Middle = JARA_ARM::ManipulatorCommonInterface_Middle;
    CHECK(std::string(Common::_PD_repoId) == "IDL:JARA_ARM/ManipulatorCommonInterface_Common:1.0");
    CHECK(std::string(Middle::_PD_repoId) == "IDL:JARA_ARM/ManipulatorCommonInterface_Middle:1.0");
    CHECK(std::string(Img::CameraCaptureService::_PD_repoId) == "IDL:Img/CameraCaptureService:1.0");
    CHECK(std::string(RTC::ExtendedFsmService::_PD_repoId) == "IDL:omg.org/RTC/ExtendedFsmService:1.0");
}

TEST_CASE("Names of the name server are converted to text and back") {
    const CosNaming::Name name = RTC::CorbaNaming::toName("pc.host_cxt/arm.v2.rtc/x");
    REQUIRE(name.length() == 3);
    CHECK(std::string(name[1].id) == "arm.v2");
    CHECK(std::string(name[1].kind) == "rtc");
    CHECK(std::string(name[2].kind).empty());
    const CORBA::String_var text = RTC::CorbaNaming::toString(name);
    CHECK(std::string(text) == "pc.host_cxt/arm.v2.rtc/x");
    CHECK(RTC::CorbaNaming::subName(name, 1).length() == 2);
    CHECK(std::string(RTC::CorbaNaming::subName(name, 0, 0)[0].id) == "pc");
    CHECK_THROWS_AS(RTC::CorbaNaming::toName(""), RTC::CorbaNaming::InvalidName);
}
