// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/fixtures/Pose.h"
#include "tests/host/opros/runtime/recording_archive.hpp"

#include <archive/opros_archive_smart_ptr.h>
#include <catch2/catch.hpp>
#include <device/ApiTypes.h>
#include <device/Property.h>
#include <queue>
#include <stack>

using opros::archive::is_serializable;

namespace {
enum Color { red, green };
struct Opaque {
    int* handle = nullptr;
};
template <typename T>
std::string structure() {
    TypeRecorder recorder;
    T value = T();
    recorder >> value;
    return recorder.text;
}
} // namespace

TEST_CASE("each type has its name on ports") {
    CHECK(getTypeName<double>() == "double");
    CHECK(getTypeName<std::vector<std::vector<unsigned char>>>() ==
          "std::vector<std::vector<unsigned char>>");
    CHECK(getTypeName<std::map<std::string, int>>() == "std::map<std::string,int>");
    CHECK(getTypeName<std::queue<std::string>>() == "std::queue<std::string>");
    CHECK(getTypeName<std::priority_queue<Pose>>() == "std::priority_queue<Pose>");
    CHECK(getTypeName<Pose>() == "Pose");
    CHECK(getTypeName<std::vector<Pose>*>() == "std::vector<Pose>*");
    CHECK(getTypeName<Color>() == "Enum");
    CHECK(getTypeName<void>() == "void");
    CHECK(getTypeName<Opaque>().find("Opaque") != std::string::npos);
}

TEST_CASE("is_serializable tells at compile time which types can be archived") {
    CHECK(is_serializable<Pose>::value);
    CHECK(is_serializable<std::map<std::string, std::vector<Point>>>::value);
    CHECK(is_serializable<opros::smart_ptr<Pose>>::value);
    CHECK(is_serializable<Color>::value);
    CHECK_FALSE(is_serializable<Opaque>::value);
    CHECK_FALSE(is_serializable<std::vector<Opaque>>::value);
    CHECK(is_serializable<std::queue<Point>>::value);
    CHECK_FALSE(is_serializable<std::stack<Opaque>>::value);
    CHECK_FALSE(is_serializable<double*>::value);
    CHECK(has_opros_serialization<Pose>::value);
    CHECK_FALSE(has_opros_serialization<Point>::value);
}

TEST_CASE("values are read back from the binary archive unchanged") {
    CHECK(through_archive(std::string("a\0b", 3)) == std::string("a\0b", 3));
    CHECK(through_archive(std::wstring(L"w")) == L"w");
    CHECK(through_archive(std::vector<double>{1, 2.5}) == std::vector<double>{1, 2.5});
    CHECK(through_archive(std::vector<bool>{true, false, true}) == std::vector<bool>{true, false, true});
    CHECK(through_archive(std::map<std::string, int>{{"a", 1}, {"b", 2}})["b"] == 2);
    CHECK(through_archive(std::set<int>{3, 1}) == std::set<int>{1, 3});
    CHECK(through_archive(std::complex<float>(1, -1)) == std::complex<float>(1, -1));
    CHECK(through_archive(green) == green);
    std::stack<int> stack;
    stack.push(1);
    stack.push(2);
    CHECK(through_archive(stack) == stack);
    std::queue<std::string> queue;
    queue.push("first");
    queue.push("second");
    CHECK(through_archive(queue) == queue);
    std::priority_queue<int> by_size;
    for (const int each : {2, 3, 1}) by_size.push(each);
    std::priority_queue<int> read_back = through_archive(by_size);
    CHECK(read_back.size() == 3);
    CHECK(read_back.top() == 3);
    Property property;
    property.SetValue("k", "v");
    CHECK(through_archive(property).GetValue("k") == "v");
}

TEST_CASE("user types are read back, whichever way they are saved") {
    Pose pose;
    pose.frame = "base";
    pose.path.resize(2);
    pose.path[1].y = -3;
    pose.weights[2] = 9;
    const Pose copy = through_archive(pose);
    CHECK(copy.frame == "base");
    CHECK(copy.path[1].y == -3);
    CHECK(copy.weights[2] == 9);
}

TEST_CASE("a double in the binary format is its code, its size and its bytes") {
    BinaryPipe pipe;
    pipe.out << 42.5;
    const std::string bytes = pipe.bytes.str();
    REQUIRE(bytes.size() == 10);
    CHECK(bytes[0] == 'd');
    CHECK(bytes[1] == 8);
}

TEST_CASE("malformed binary input ends in an archive exception") {
    std::vector<double> target;
    SECTION("a count that the bytes cannot hold") {
        BinaryPipe pipe;
        pipe.out << std::vector<double>{1};
        std::string bytes = pipe.bytes.str();
        bytes[bytes.find("I\4") + 4] = 0x7f;
        std::istringstream in(bytes);
        opros::archive::binary_iarchive archive(&in);
        CHECK_THROWS_AS(archive >> target, opros::archive::archive_array_size_exception);
    }
    SECTION("another type") {
        BinaryPipe pipe;
        pipe.out << 1;
        CHECK_THROWS_AS(pipe.in >> target, opros::archive::archive_type_exception);
    }
    SECTION("nothing") {
        BinaryPipe pipe;
        CHECK_THROWS_AS(pipe.in >> target, opros::archive::archive_format_exception);
    }
}

TEST_CASE("an archive of a bridge sees the structure of every type") {
    CHECK(structure<std::vector<double>>() == "ad");
    CHECK(structure<Pose>() == "(sa(dd)[3]i)");
    CHECK(structure<std::map<std::string, int>>() == "a(si)");
    CHECK(structure<JoystickData>() == "(dddab)");
    CHECK(structure<Color>() == "i");
}

TEST_CASE("a block of bytes is loaded with its length, and never beyond the caller's memory") {
    BinaryPipe pipe;
    pipe.out.save("abc", 3).save("defg", 4);
    char* made = nullptr;
    long size = 0;
    pipe.in.load(&made, size);
    CHECK(std::string(made, static_cast<std::size_t>(size)) == "abc");
    delete[] made;
    char room[2];
    char* p = room;
    CHECK_THROWS_AS(pipe.in.load(&p, 2), opros::archive::archive_array_size_exception);
}
