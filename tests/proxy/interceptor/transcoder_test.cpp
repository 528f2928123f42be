// SPDX-License-Identifier: Apache-2.0
// Every kind of type between the ORB's streams and the link's CDR, against compiled stubs.
#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/interceptor/corba/typecode.hpp"
#include "proxy/wire/wide_text.hpp"
#include "tests/proxy/interceptor/anys_of_everything.hpp"
#include "tests/proxy/interceptor/orb.hpp"

#include <rtm/InterfaceSignatures.h>

#include <catch2/catch.hpp>

#include <cstring>
#include <functional>
#include <random>
#include <vector>

using namespace tandem;
using interceptor::from_cdr;
using interceptor::Orb;
using interceptor::to_cdr;
using namespace tandem::test;

namespace {

std::vector<std::byte> crossed(const wire::Type& type, cdrMemoryStream& stream) {
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    to_cdr(type, stream, writer);
    return bytes;
}

auto refused_as(const std::string& reason) {
    return Catch::Predicate<interceptor::RefusedValue>(
        [reason](const auto& error) { return error.reason() == reason; }, reason);
}

wire::Type type_of_all() { return interceptor::type_of(TestTypes::_tc_All); }

} // namespace

TEST_CASE(
    "a TypeCode's signature has every kind of member, and a type that contains itself has no signature") {
    Orb orb;
    CHECK(RTC::InterfaceSignatures::signature(TestTypes::_tc_All) ==
          "({first}y{precise}D{sign}W{title}w#20{state}e#3{states}ae#3{order}<e#3;0={brake}b;1,2={speed}d>{"
          "mail}<c;"
          "97={number}i;*={text}s>{cost}F7,2{content}v{secret}a#4y{label}s#8{table}[2][3]d)");
    CHECK(RTC::InterfaceSignatures::signature(TestTypes::_tc_Node) ==
          "({value}i{below}a?{a type that contains itself, whose depth only each value knows})");
}

TEST_CASE("a structure of every kind of type crosses in both directions, also within a sequence") {
    Orb orb;
    TestTypes::Alls alls;
    alls.length(3);
    for (CORBA::ULong i = 0; i < 3; ++i) alls[i] = all_kinds();
    alls[1].order.brake(true);
    alls[1].mail.number(5);
    alls[2].title = CORBA::wstring_dup(L"");
    cdrMemoryStream sent;
    alls >>= sent;
    const auto type = interceptor::type_of(TestTypes::_tc_Alls);
    const auto bytes = crossed(type, sent);
    cdrMemoryStream received;
    wire::CdrReader reader(bytes);
    from_cdr(type, reader, received);
    CHECK(reader.remaining() == 0);
    TestTypes::Alls back;
    back <<= received;
    REQUIRE(back.length() == 3);
    CHECK(back[0].precise == 1.0L / 3);
    CHECK(back[0].sign == L'\u00e9');
    CHECK(std::wstring(back[0].title.in()) == L"caf\u00e9 \ud55c");
    CHECK(back[0].states[0] == TestTypes::slow);
    CHECK(back[0].order._d() == TestTypes::fast);
    CHECK(back[0].order.speed() == 2.5);
    CHECK(std::string(back[0].mail.text()) == "hello");
    CHECK(std::string(CORBA::String_var(back[0].cost.NP_asString()).in()) == "-123.45");
    CORBA::Double content = 0;
    CHECK((back[0].content >>= content));
    CHECK(content == 0.25);
    CHECK(back[0].table[1][2] == 5);
    CHECK(back[1].order.brake());
    CHECK(back[1].mail.number() == 5);
    CHECK(std::wstring(back[2].title.in()).empty());
    CHECK(back[2].secret.length() == 3);
}

TEST_CASE("a fixed crosses as its decimal text and an any as signature and value") {
    Orb orb;
    TestTypes::All all = all_kinds();
    TestTypes::Command order;
    order.speed(4);
    all.content <<= order;
    cdrMemoryStream fixed, any;
    all.cost >>= fixed;
    all.content >>= any;
    const auto text = crossed(wire::parse_signature("F7,2"), fixed);
    CHECK(wire::CdrReader(text).get_string() == "-123.45");
    const auto value = crossed(wire::parse_signature("v"), any);
    wire::CdrReader reader(value);
    CHECK(reader.get_string() ==
          "{IDL:TestTypes/Command:1.0}<{IDL:TestTypes/Mode:1.0 off,slow,fast}e#3;0={brake}b;1,2={"
          "speed}d>");
    CHECK(reader.get_count(1) == 16);
}

namespace {

CORBA::Any crossed(const CORBA::Any& any) {
    const auto type = wire::parse_signature("v");
    cdrMemoryStream sent, received;
    any >>= sent;
    const auto bytes = crossed(type, sent);
    wire::CdrReader reader(bytes);
    from_cdr(type, reader, received);
    CORBA::Any back;
    back <<= received;
    return back;
}

} // namespace

TEST_CASE("an any of every type crosses without damage") {
    Orb orb;
    for (const auto& [name, any] : anys_of_everything()) {
        INFO(name);
        CHECK(is_same_any(any, crossed(any)));
    }
    CORBA::Any holder = crossed(any_of_holder());
    const TestTypes::Holder* extracted = nullptr;
    REQUIRE((holder >>= extracted));
    const TestTypes::One* inner = nullptr;
    REQUIRE((extracted->content >>= inner));
    CHECK(inner->number == 3);
}

TEST_CASE("an any of a type that cannot cross is refused with the reason") {
    Orb orb;
    CHECK_THROWS_MATCHES(crossed(any_of(TestTypes::Node())), interceptor::RefusedValue,
                         refused_as("an any contains a type that cannot cross: "
                                    "a type that contains itself, whose depth only each value knows"));
    CHECK_THROWS_MATCHES(crossed(any_of(CORBA::_tc_long)), interceptor::RefusedValue,
                         refused_as("an any contains a type that cannot cross: TypeCode"));
    CORBA::Any nested;
    for (int i = 0; i < 9; ++i) nested = any_of(nested);
    CHECK_THROWS_MATCHES(crossed(nested), interceptor::RefusedValue,
                         refused_as("anys are nested more than 8 deep"));
}

TEST_CASE("a fixed is refused if it would have to be rounded, and may end with zeros") {
    Orb orb;
    const auto type = wire::parse_signature("F5,2");
    const auto cross = [&](const char* text) {
        std::vector<std::byte> bytes;
        wire::CdrWriter writer(bytes);
        writer.put_string(text);
        cdrMemoryStream stream;
        wire::CdrReader reader(bytes);
        from_cdr(type, reader, stream);
        CORBA::Fixed value;
        value.PR_setLimits(5, 2);
        value <<= stream;
        return std::string(CORBA::String_var(value.NP_asString()).in());
    };
    CHECK(cross("123.45") == "123.45");
    CHECK(cross("+00123.4500") == "123.45");
    CHECK(cross("-.5") == "-0.5");
    for (const char* text : {"1.234", "1234", "abc", "", "1.2.3", "1e2"})
        CHECK_THROWS_AS(cross(text), interceptor::RefusedValue);
}

namespace {

/// Returns the any that an OPRoS component makes of a signature and a value.
CORBA::Any any_from(const std::string& signature, const std::vector<std::byte>& value) {
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    writer.put_string(signature);
    writer.put(static_cast<std::uint32_t>(value.size()));
    writer.put_block(value.data(), value.size(), 1);
    cdrMemoryStream stream;
    wire::CdrReader reader(bytes);
    from_cdr(wire::parse_signature("v"), reader, stream);
    CORBA::Any any;
    any <<= stream;
    return any;
}

std::vector<std::byte> cdr_of(std::uint32_t number) {
    std::vector<std::byte> bytes;
    wire::CdrWriter(bytes).put(number);
    return bytes;
}

} // namespace

TEST_CASE("an any that the peer makes of a structure can be extracted by code that knows its type") {
    Orb orb;
    std::vector<std::byte> inner;
    wire::CdrWriter value(inner);
    value.put(std::int32_t{-5});
    value.put_string("text");
    const CORBA::Any any = any_from("{number}i{text}s", inner);
    const CORBA::TypeCode_var code = any.type();
    CHECK(code->kind() == CORBA::tk_struct);
    CHECK(std::string(code->member_name(1)) == "text");
}

TEST_CASE(
    "an any of nested structures without ids is sent on, and an enumeration without names is a number") {
    Orb orb;
    const CORBA::Any nested = any_from("({a}({b}u))", cdr_of(5));
    CHECK(is_same_any(nested, crossed(nested)));
    const CORBA::Any enumeration = any_from("e#4294967295", cdr_of(5));
    CORBA::ULong number = 0;
    CHECK((enumeration >>= number));
    CHECK(number == 5);
}

TEST_CASE("a hostile type of an any is refused before it takes memory or time") {
    Orb orb;
    const auto refuses = [](const std::string& signature, const std::string& reason) {
        CHECK_THROWS_MATCHES(any_from(signature, cdr_of(0)), interceptor::RefusedValue, refused_as(reason));
    };
    std::string ids, labels = "0";
    for (int i = 0; i < 33; ++i) ids += "{a:}";
    for (int i = 1; i <= 4096; ++i) labels += "," + std::to_string(i);
    refuses(ids + "u", "the type of an any's value cannot be read: a type has more than 32 ids");
    refuses("<u;" + labels + "=u>", "a union of an any has more than 4096 labels");
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(CORBA::_tc_long);
    for (int i = 0; i < 40; ++i) { // each contains the one before twice
        CORBA::StructMemberSeq members;
        members.length(2);
        for (CORBA::ULong k = 0; k < 2; ++k) {
            members[k].name = k == 0 ? "a" : "b";
            members[k].type = CORBA::TypeCode::_duplicate(code.in());
        }
        int no_arguments = 0;
        const CORBA::ORB_var process_orb = CORBA::ORB_init(no_arguments, nullptr);
        code = process_orb->create_struct_tc(("IDL:S" + std::to_string(i) + ":1.0").c_str(), "S", members);
    }
    CHECK_THAT(RTC::InterfaceSignatures::signature(code.in()), Catch::StartsWith("?{"));
}

TEST_CASE("a wide text with a NUL is refused") {
    Orb orb;
    std::vector<std::byte> bytes;
    wire::CdrWriter writer(bytes);
    REQUIRE(wire::put_wide_string(writer, std::wstring_view(L"a\0b", 3)));
    wire::CdrReader reader(bytes);
    cdrMemoryStream stream;
    CHECK_THROWS_MATCHES(from_cdr(wire::parse_signature("w"), reader, stream), interceptor::RefusedValue,
                         refused_as("a wide string contains a NUL"));
}

TEST_CASE("values beyond a bound or without an enumerator are refused in both directions") {
    Orb orb;
    const auto refuses = [](const char* signature, const std::function<void(wire::CdrWriter&)>& write) {
        std::vector<std::byte> bytes;
        wire::CdrWriter writer(bytes);
        write(writer);
        const auto type = wire::parse_signature(signature);
        cdrMemoryStream stream, same;
        same.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(bytes.data()),
                             static_cast<int>(bytes.size()), omni::ALIGN_1);
        wire::CdrReader reader(bytes);
        CHECK_THROWS_AS(from_cdr(type, reader, stream), CORBA::SystemException);
        std::vector<std::byte> out;
        wire::CdrWriter to(out);
        CHECK_THROWS_AS(to_cdr(type, same, to), CORBA::SystemException);
    };
    refuses("s#3", [](auto& out) { out.put_string("four"); });
    refuses("a#2y", [](auto& out) {
        out.template put<std::uint32_t>(3);
        out.put_block("abc", 3, 1);
    });
    refuses("e#3", [](auto& out) { out.template put<std::uint32_t>(3); });
    refuses("<e#3;0=d>", [](auto& out) { out.template put<std::uint32_t>(7); });
}

TEST_CASE("bytes damaged on the way cause an exception or another value, never a crash") {
    Orb orb;
    const auto type = type_of_all();
    cdrMemoryStream sent;
    all_kinds() >>= sent;
    const auto whole = crossed(type, sent);
    std::mt19937 random(1);
    int refused = 0, accepted = 0;
    for (int round = 0; round < 3000; ++round) {
        auto bytes = whole;
        for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        cdrMemoryStream stream;
        wire::CdrReader reader(bytes);
        try {
            from_cdr(type, reader, stream);
            ++accepted;
        } catch (const CORBA::SystemException&) {
            ++refused;
        }
    }
    CHECK(refused > 0);
    CHECK(accepted > 0);
}
