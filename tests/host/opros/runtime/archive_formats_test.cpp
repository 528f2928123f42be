// SPDX-License-Identifier: Apache-2.0
// The text archive and the raw one: every kind of value comes back, and malformed input ends in an exception.
#include "tests/host/opros/fixtures/Pose.h"

#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

using namespace opros::archive;

namespace {

enum Shade { light, dark };

Pose some_pose() {
    Pose pose;
    pose.frame = "a;b]c";
    pose.path = {{1, 2}, {0.1, -1e300}};
    pose.weights[1] = -7;
    return pose;
}

template <typename Out, typename T, typename... Mode>
std::string saved(const T& value, Mode... mode) {
    std::ostringstream bytes;
    Out archive(&bytes, mode...);
    archive << value;
    return bytes.str();
}
template <typename In, typename T>
T loaded(const std::string& text) {
    std::istringstream bytes(text);
    In archive(&bytes);
    T value = T();
    archive >> value;
    CHECK(bytes.peek() == std::char_traits<char>::eof()); // all of it has been read
    return value;
}

template <typename Out, typename In, typename... Mode>
void check_all_kinds(Mode... mode) {
    const auto same = [&](const auto& value) {
        typedef typename std::decay<decltype(value)>::type T;
        return loaded<In, T>(saved<Out>(value, mode...)) == value;
    };
    CHECK(same(true));
    CHECK(same('x'));
    CHECK(same(';'));
    CHECK(same('X'));
    CHECK(same(static_cast<unsigned char>(200)));
    CHECK(same(L';'));
    CHECK(same(L'\x20ac'));
    CHECK(same(static_cast<short>(-3)));
    CHECK(same(static_cast<unsigned long long>(-1)));
    CHECK(same(std::numeric_limits<long>::min()));
    CHECK(same(0.1f));
    CHECK(same(0.1));
    CHECK(same(0.1L));
    CHECK(same(dark));
    CHECK(same(std::string("a;]\0b", 5)));
    CHECK(same(std::wstring(L"w\x20ac")));
    CHECK(same(std::vector<double>{1.5, -2}));
    CHECK(same(std::vector<bool>{true, false}));
    CHECK(same(std::vector<std::vector<std::string>>{{"a"}, {}, {"b", "c"}}));
    CHECK(same(std::map<std::string, int>{{"a", 1}, {"b", 2}}));
    CHECK(same(std::complex<double>(1, -1)));
    const Pose pose = loaded<In, Pose>(saved<Out>(some_pose(), mode...));
    CHECK(pose.frame == "a;b]c");
    REQUIRE(pose.path.size() == 2);
    CHECK(pose.path[1].y == -1e300);
    CHECK(pose.weights[1] == -7);
}

} // namespace

TEST_CASE("every kind of value is read back from the text archive, in decimal and in hexadecimal") {
    check_all_kinds<string_oarchive, string_iarchive>();
    check_all_kinds<string_oarchive, string_iarchive>(1);
}

TEST_CASE("every kind of value is read back from the raw archive") {
    check_all_kinds<raw_oarchive, raw_iarchive>();
}

TEST_CASE("the text archive writes readable text") {
    CHECK(saved<string_oarchive>(-5) == "I-5;");
    CHECK(saved<string_oarchive>(true) == "ZT;");
    CHECK(saved<string_oarchive>(std::string("ab")) == "T[std::string]L2;G[2]ab;;");
    CHECK(saved<string_oarchive>(std::vector<short>{1, 2}) == "T[std::vector<short>]I2;i1;i2;;");
    CHECK(saved<string_oarchive>(Point{1, 2}) == "T[Point]d1;d2;;");
}

TEST_CASE("the raw archive writes the bytes of numbers without type codes") {
    CHECK(saved<raw_oarchive>(static_cast<short>(258)) == "\2\1");
    CHECK(saved<raw_oarchive>(Point{0, 0}).size() == 16);
    CHECK(saved<raw_oarchive>(std::vector<short>{1}).size() == sizeof(int) + 2);
}

TEST_CASE("malformed text ends in an archive exception") {
    CHECK_THROWS_AS((loaded<string_iarchive, int>("")), archive_format_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, int>("I5")), archive_format_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, int>("I5x;")), archive_format_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, int>("Xabc;")), archive_type_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, int>("IX0g000000;")), archive_format_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, int>("d5;")), archive_type_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, bool>("Z1;")), archive_format_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, std::string>("T[std::string]L9;G[999999999]a;;")),
                    archive_array_size_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, std::vector<int>>("T[std::vector<int>]I-1;;")),
                    archive_array_size_exception);
    CHECK_THROWS_AS((loaded<string_iarchive, Point>("T[Pose]d1;d2;;")), archive_type_exception);
}

TEST_CASE("too few raw bytes end in an archive exception") {
    CHECK_THROWS_AS((loaded<raw_iarchive, double>("abc")), archive_format_exception);
    CHECK_THROWS_AS((loaded<raw_iarchive, std::vector<double>>(std::string("\xff\xff\xff\x7f", 4))),
                    archive_array_size_exception);
    CHECK_THROWS_AS((loaded<raw_iarchive, wchar_t>("\3\xe2\x82")), archive_format_exception);
    CHECK_THROWS_AS((loaded<raw_iarchive, wchar_t>("\2\xc0\x80")), archive_format_exception);
}
