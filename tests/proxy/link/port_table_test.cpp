// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/request.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tandem::link;

namespace {
PortTable wheelchair() {
    return {
        {{"JoystickComp0", "JoystickComp", {{"gain", "2"}, {"axis", "x"}}}, {"Spare0"}},
        {{PortKind::data_out, "reference", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}, "JoystickComp0"},
         {PortKind::data_in, "joystickPos", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}},
         {PortKind::service_required, "chair", "Chair", "", "chair0", {{"limits", ":ad"}, {"stop", ":b"}}}}};
}
} // namespace

TEST_CASE("a port table comes out as it went in") {
    const auto table = wheelchair();
    const auto back = decode_port_table(encode(table));
    CHECK(back == table);
    REQUIRE(back.find("chair") != nullptr);
    CHECK(back.find("chair")->operations.size() == 2);
    CHECK(back.find("nobody") == nullptr);
    CHECK(back.component_names() == "JoystickComp0, Spare0");
}

TEST_CASE("a port table that was cut short anywhere is refused") {
    const auto bytes = encode(wheelchair());
    for (std::size_t length = 0; length < bytes.size(); ++length)
        CHECK_THROWS_AS(decode_port_table(std::span(bytes).first(length)), LinkError);
}

TEST_CASE("damaged port tables are refused or read, never more") {
    const auto good = encode(wheelchair());
    std::mt19937 random(7);
    for (int round = 0; round < 5000; ++round) {
        auto bytes = good;
        bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        try {
            const auto table = decode_port_table(bytes);
            CHECK(table.ports.size() <= bytes.size());
        } catch (const LinkError&) {
            SUCCEED();
        }
    }
}

TEST_CASE("state reports and settings come out as they went in, and are refused when cut short") {
    const auto report = control::encode(control::StateReport{"Camera", control::ComponentState::error, 7});
    const auto back = control::decode_state_report(report);
    CHECK((back.component == "Camera" && back.state == control::ComponentState::error && back.sequence == 7));
    CHECK_THROWS_AS(control::decode_state_report(std::span(report).first(report.size() - 1)), LinkError);
    auto unknown = control::encode(control::StateReport{"Camera", control::ComponentState{4}, 7});
    CHECK_THROWS_AS(control::decode_state_report(unknown), LinkError);
    const auto setting = control::encode(control::Setting{"Camera", "gain", "2.5"});
    const auto set = control::decode_setting(setting);
    CHECK((set.component == "Camera" && set.name == "gain" && set.value == "2.5"));
    CHECK_THROWS_AS(control::decode_setting(std::span(setting).first(setting.size() - 1)), LinkError);
}

TEST_CASE("a request comes out as it went in, its arguments aligned to 8") {
    const std::vector<std::byte> arguments{std::byte{1}, std::byte{2}, std::byte{3}};
    std::vector<std::byte> bytes;
    encode(Request{"chair", "limits", "i:ad", arguments}, bytes);
    const auto back = decode_request(bytes);
    REQUIRE(back);
    CHECK(back->port == "chair");
    CHECK(back->operation == "limits");
    CHECK(back->signature == "i:ad");
    CHECK(std::vector<std::byte>(back->arguments.begin(), back->arguments.end()) == arguments);
    CHECK((back->arguments.data() - bytes.data()) % 8 == 0);
}

TEST_CASE("bytes that are no request are recognized") {
    std::vector<std::byte> bytes;
    encode(Request{"chair", "limits", ":ad", {}}, bytes);
    CHECK(decode_request(bytes));
    bytes.resize(10);
    CHECK_FALSE(decode_request(bytes));
    CHECK_FALSE(decode_request({}));
}
