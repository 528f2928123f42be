// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/wire/type.hpp"

#include <catch2/catch.hpp>

#include <OPRoSTypes.h>

#include <limits>
#include <map>
#include <string>
#include <valarray>
#include <vector>

using namespace tandem;

namespace scan {
/// A data type in the style of real components: members, save() and load().
struct Pose {
    double x = 0, y = 0;
    std::string frame;
    void save(opros::archive::oarchive& ar, const unsigned int) {
        ar << OPROS_SERIALIZATION_NVP(x) << OPROS_SERIALIZATION_NVP(y) << OPROS_SERIALIZATION_NVP(frame);
    }
    void load(opros::archive::iarchive& ar, const unsigned int) {
        ar >> OPROS_SERIALIZATION_NVP(x) >> OPROS_SERIALIZATION_NVP(y) >> OPROS_SERIALIZATION_NVP(frame);
    }
};
inline std::string typeName(Pose*) { return "scan::Pose"; }

struct Scan {
    int id = 0;
    std::vector<Pose> poses;
    float rays[4] = {};
    bool valid = false;
};
inline std::string typeName(Scan*) { return "scan::Scan"; }
inline void save_this(opros::archive::oarchive& ar, Scan& scan) {
    ar << scan.id << scan.poses << scan.rays << scan.valid;
}
inline void load_this(opros::archive::iarchive& ar, Scan& scan) {
    ar >> scan.id >> scan.poses >> scan.rays >> scan.valid;
}

enum class Mode { off, slow, fast };
inline std::string typeName(Mode*) { return "Mode"; }

/// With names for its members.
struct Point {
    double x = 0, y = 0;
};
inline void save_this(opros::archive::oarchive& ar, Point& p) {
    ar << OPROS_SERIALIZATION_MAKE_NVP(x, p.x) << OPROS_SERIALIZATION_MAKE_NVP(y, p.y);
}
inline void load_this(opros::archive::iarchive& ar, Point& p) {
    ar >> OPROS_SERIALIZATION_MAKE_NVP(x, p.x) >> OPROS_SERIALIZATION_MAKE_NVP(y, p.y);
}
struct Named {
    float speed = 0;
    Point where;
    std::vector<std::string> tags;
};
inline void save_this(opros::archive::oarchive& ar, Named& n) {
    ar << OPROS_SERIALIZATION_MAKE_NVP(speed, n.speed) << OPROS_SERIALIZATION_MAKE_NVP(where, n.where)
       << OPROS_SERIALIZATION_MAKE_NVP(tags, n.tags);
}
inline void load_this(opros::archive::iarchive& ar, Named& n) {
    ar >> OPROS_SERIALIZATION_MAKE_NVP(speed, n.speed) >> OPROS_SERIALIZATION_MAKE_NVP(where, n.where) >>
        OPROS_SERIALIZATION_MAKE_NVP(tags, n.tags);
}

/// A union of IDL, written by hand: a kind, then the members of that kind.
struct Shape {
    int kind = 0;
    double radius = 0;
    Point size;
    std::string name;
};
inline void save_this(opros::archive::oarchive& ar, Shape& s) {
    ar << s.kind;
    if (s.kind == 0) ar << s.radius;
    if (s.kind == 1) ar << s.size;
    if (s.kind > 1) ar << s.name;
}
inline void load_this(opros::archive::iarchive& ar, Shape& s) {
    ar >> s.kind;
    if (s.kind == 0) ar >> s.radius;
    if (s.kind == 1) ar >> s.size;
    if (s.kind > 1) ar >> s.name;
}

struct Node {
    int value = 0;
    std::vector<Node> children;
};
void save_this(opros::archive::oarchive& ar, Node& n);
void load_this(opros::archive::iarchive& ar, Node& n);
inline void save_this(opros::archive::oarchive& ar, Node& n) { ar << n.value << n.children; }
inline void load_this(opros::archive::iarchive& ar, Node& n) { ar >> n.value >> n.children; }
} // namespace scan

namespace {
template <class T>
std::string signature() {
    return wire::to_signature(adaptor::type_of(opros_any(T()), {}));
}

template <class T>
std::vector<std::byte> encoded(const T& value) {
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    adaptor::CdrOarchive archive(writer);
    opros_any(value).encode(archive);
    return bytes;
}
template <class T>
T decoded(std::span<const std::byte> bytes) {
    adaptor::CdrIarchive archive{wire::CdrReader(bytes)};
    T value = T();
    archive >> value;
    return value;
}
} // namespace

TEST_CASE("C++ types have the signature of the IDL type with the same CDR") {
    CHECK(signature<bool>() == "b");
    CHECK(signature<char>() == "c");
    CHECK(signature<unsigned char>() == "y");
    CHECK(signature<short>() == "n");
    CHECK(signature<int>() == "i");
    CHECK(signature<unsigned int>() == "u");
    CHECK(signature<long>() == "x");
    CHECK(signature<unsigned long long>() == "t");
    CHECK(signature<float>() == "f");
    CHECK(signature<double>() == "d");
    CHECK(signature<std::string>() == "s");
    CHECK(signature<std::vector<double>>() == "ad");
    CHECK(signature<std::vector<bool>>() == "ab");
    CHECK(signature<std::vector<std::vector<int>>>() == "aai");
    CHECK(signature<std::vector<std::string>>() == "as");
    CHECK(signature<std::valarray<double>>() == "ad");
    CHECK(signature<std::vector<unsigned char>>() == "ay");
}

TEST_CASE("a user's type has the signature that its own serialization shows") {
    CHECK(signature<scan::Pose>() == "dds");
    CHECK(signature<std::vector<scan::Pose>>() == "a(dds)");
    CHECK(signature<scan::Scan>() == "ia(dds)[4]fb");
}

TEST_CASE("long double, wide characters, enumerations and maps have signatures, too") {
    CHECK(signature<long double>() == "D");
    CHECK(signature<wchar_t>() == "W");
    CHECK(signature<std::wstring>() == "w");
    CHECK(signature<scan::Mode>() == "i");
    CHECK(signature<std::map<std::string, double>>() == "a(sd)");
    CHECK(signature<std::pair<int, std::string>>() == "is");
    CHECK(signature<std::complex<double>>() == "dd");
}

TEST_CASE("the named signature contains the names under which members are archived") {
    CHECK(wire::to_named_signature(adaptor::type_of(opros_any(scan::Named()), {})) ==
          "{speed}f{where}({x}d{y}d){tags}as");
}

TEST_CASE("a load() that reads different members for each kind fits a union with these cases") {
    const auto type = [](const char* peer) {
        return wire::to_signature(adaptor::type_of(opros_any(scan::Shape()), wire::parse_signature(peer)));
    };
    for (const char* peer : {"<i;0=d;1=(dd);2=s>", "(uu)<e#3;0=d;1=(dd);2=s>", "i(i<i;0=d;1=(dd);*=s>)"}) {
        const bool shape_alone = peer[0] != 'i';
        CHECK((type(peer).find('<') != std::string::npos) == shape_alone);
    }
    CHECK(type("<i;0=d;1=(dd);*=s>") == "<i;0=d;1=(dd);*=s>"); // load() takes 2 and above for a name
    CHECK(type("<i;0=d;1=f>") == "id"); // its kind 1 is not a float: the branch for zeros is shown
    CHECK(type("") == "id");
}

TEST_CASE("a type that contains itself is refused with that reason") {
    const link::Port port{link::PortKind::data_in, "tree", "IDL:Tree:1.0", "i", "", {}};
    CHECK_THAT(adaptor::check_type(opros_any(scan::Node()), port, true).error,
               Catch::Contains("'tree'") && Catch::Contains("contains itself"));
}

TEST_CASE("values that CORBA cannot hold are refused, not cut") {
    CHECK_THROWS(encoded(std::string("a\0b", 3)));
    CHECK_THROWS(encoded(std::wstring(L"a\0b", 3)));
    CHECK_THROWS(encoded(std::wstring(L"\U0001F600")));
}

TEST_CASE("a block of bytes of an impossible size is refused") {
    for (const long size : {-1L, std::numeric_limits<long>::min(), 1L << 32}) {
        std::vector<std::byte> bytes;
        wire::CdrWriter out(bytes);
        adaptor::CdrOarchive archive(out);
        CHECK_THROWS_AS(archive.save("", size), opros::archive::archive_array_size_exception);
    }
}

TEST_CASE("values are read back unchanged") {
    CHECK(decoded<double>(encoded(-1.5)) == -1.5);
    CHECK(decoded<std::string>(encoded(std::string("motor"))) == "motor");
    CHECK(decoded<long double>(encoded(1.25L)) == 1.25L);
    CHECK(decoded<wchar_t>(encoded(L'\u00e9')) == L'\u00e9');
    CHECK(decoded<std::wstring>(encoded(std::wstring(L"moteur \u00e9\ud55c"))) == L"moteur \u00e9\ud55c");
    CHECK(decoded<std::wstring>(encoded(std::wstring())).empty());
    CHECK(decoded<scan::Mode>(encoded(scan::Mode::fast)) == scan::Mode::fast);
    const std::map<std::string, double> weights{{"left", 1}, {"right", 2.5}};
    CHECK(decoded<std::map<std::string, double>>(encoded(weights)) == weights);
    const std::vector<double> numbers{1, 2.5, -3};
    CHECK(decoded<std::vector<double>>(encoded(numbers)) == numbers);
    const std::vector<bool> flags{true, false, true};
    CHECK(decoded<std::vector<bool>>(encoded(flags)) == flags);
    const std::vector<std::vector<int>> nested{{1}, {}, {2, 3}};
    CHECK(decoded<std::vector<std::vector<int>>>(encoded(nested)) == nested);

    scan::Scan scan;
    scan.id = 7;
    scan.poses.resize(2);
    scan.poses[1].frame = "map";
    scan.poses[1].y = 4;
    scan.rays[3] = 0.25f;
    scan.valid = true;
    const auto back = decoded<scan::Scan>(encoded(scan));
    CHECK(back.id == 7);
    REQUIRE(back.poses.size() == 2);
    CHECK(back.poses[1].frame == "map");
    CHECK(back.poses[1].y == 4);
    CHECK(back.rays[3] == 0.25f);
    CHECK(back.valid);
}

TEST_CASE("a vector of double is its count, padding and its elements") {
    const auto bytes = encoded(std::vector<double>{1.0});
    const unsigned char expected[] = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
    REQUIRE(bytes.size() == sizeof expected);
    CHECK(std::memcmp(bytes.data(), expected, sizeof expected) == 0);
}

TEST_CASE("too few bytes for the type are an error, whatever the bytes are") {
    const auto whole = encoded(scan::Scan());
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK_THROWS(decoded<scan::Scan>(std::span(whole).first(length)));
    const std::vector<std::byte> absurd{std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0x7f}};
    CHECK_THROWS(decoded<std::vector<double>>(absurd));
    CHECK_THROWS(decoded<std::string>(absurd));
}

TEST_CASE("a mismatching type is refused with both signatures") {
    const link::Port port{
        link::PortKind::data_in, "reference", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}};
    CHECK(adaptor::check_type(opros_any(std::vector<double>()), port, true).error.empty());
    CHECK_THAT(
        adaptor::check_type(opros_any(std::vector<int>()), port, true).error,
        Catch::Contains("'reference'") && Catch::Contains("'ai'") && Catch::Contains("'(uu)ad'") &&
            Catch::Contains("IDL:RTC/TimedDoubleSeq:1.0") &&
            Catch::Contains("field 1[] is int32 here, double there: ask for widen with convert.reference "
                            "of AdaptorComp, or use a type with that signature"));
    // No conversion exists between the two, so the message names none.
    CHECK_THAT(
        adaptor::check_type(opros_any(std::string()), port, true).error,
        Catch::Contains(
            "field 1 is string here, sequence of double there: change one of the two, to a type with that "
            "signature") &&
            !Catch::Contains("convert."));
    link::Port other = port;
    other.signature = "?{its IDL is not known}";
    CHECK_THAT(adaptor::check_type(opros_any(1.0), other, true).error,
               Catch::Contains("its IDL is not known"));
    other.signature = "(("; // another process wrote it
    CHECK_THAT(adaptor::check_type(opros_any(1.0), other, true).error,
               Catch::Contains("type signature '(('"));
}

namespace {

/// Uses the functions for a head and for elements, as an archive without save_sequence() does for a vector.
template <class T>
std::vector<std::byte> written_in_parts(const std::vector<T>& values) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    adaptor::CdrOarchive archive(out);
    archive.save(true); // so that the vector is not aligned
    archive.write_sequence_head(values.size());
    for (const T value : values) archive.save(value);
    return bytes;
}

template <class T>
void check_vector() {
    for (const std::size_t count : {0, 1, 5, 100}) {
        std::vector<T> values;
        for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<T>(i % 2 == 0 ? i + 60 : 1));
        std::vector<std::byte> bytes;
        wire::CdrWriter out(bytes);
        adaptor::CdrOarchive archive(out);
        archive << true << values;
        INFO(typeid(T).name() << " " << count);
        if (!std::is_same_v<T, long double>) // 6 of its bytes are any
            CHECK(bytes == written_in_parts(values));
        adaptor::CdrIarchive in{wire::CdrReader(bytes)};
        bool first = false;
        std::vector<T> read{T()};
        in >> first >> read;
        CHECK(read == values);
        if (count == 0) continue;
        adaptor::CdrIarchive cut{wire::CdrReader(std::span<const std::byte>(bytes).first(bytes.size() - 1))};
        cut >> first;
        CHECK_THROWS_AS(cut >> read, opros::archive::archive_type_exception);
    }
}

} // namespace

TEST_CASE("vectors of every primitive type are written as a count and their elements") {
#define CHECK_VECTOR(type) check_vector<type>();
    OPROS_FOR_EACH_PRIMITIVE(CHECK_VECTOR)
#undef CHECK_VECTOR
}
