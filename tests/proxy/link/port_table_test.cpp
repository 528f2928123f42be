// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/operation_table.hpp"
#include "proxy/link/protocol/port_settings.hpp"
#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/link/protocol/service_exception.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace tandem::link;
namespace wire = tandem::wire;

namespace {
PortTable wheelchair() {
    return {
        {{"JoystickComp0", "JoystickComp", {{"gain", "2"}, {"axis", "x"}}}, {"Spare0"}},
        {{PortKind::data_out, "reference", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}, "JoystickComp0"},
         {PortKind::data_in, "joystickPos", "IDL:RTC/TimedDoubleSeq:1.0", "(uu)ad", "", {}},
         {PortKind::service_required, "chair", "Chair", "", "chair0", {{"limits", ":ad"}, {"stop", ":b"}}}},
        "RTM"};
}
} // namespace

TEST_CASE("a port table is read back unchanged") {
    const auto table = wheelchair();
    const auto back = decode_port_table(encode(table));
    CHECK(back == table);
    REQUIRE(back.find("chair") != nullptr);
    CHECK(back.find("chair")->operations.size() == 2);
    CHECK(back.find("nobody") == nullptr);
    CHECK(back.model == "RTM");
    CHECK(back.component_names() == "JoystickComp0, Spare0");
}

/// Returns the bytes of a table without those of its model, as recordings before 0.3 have them.
static std::size_t bytes_without_model(const PortTable& table) {
    std::vector<std::byte> model;
    wire::CdrWriter(model).put_string(table.model);
    return encode(table).size() - model.size(); // the number of a ring, aligned to 4, precedes the model
}

TEST_CASE("a port table that is truncated anywhere is refused") {
    const auto table = wheelchair();
    const auto bytes = encode(table);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        if (length != bytes_without_model(table))
            CHECK_THROWS_AS(decode_port_table(std::span(bytes).first(length)), LinkError);
}

TEST_CASE("a port table from before models has no model, and nothing else is different") {
    auto table = wheelchair();
    const auto bytes = encode(table);
    const auto old = decode_port_table(std::span(bytes).first(bytes_without_model(table)));
    CHECK(old.model.empty());
    table.model.clear();
    CHECK(old == table);
}

TEST_CASE("damaged port tables are refused or read, and nothing else happens") {
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

TEST_CASE("state reports and settings are read back unchanged, and truncated ones are refused") {
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

TEST_CASE("a request is read back unchanged, its arguments aligned to 8") {
    const std::vector<std::byte> arguments{std::byte{1}, std::byte{2}, std::byte{3}};
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    encode(Request{"chair", "limits", "i:ad", arguments}, out);
    const auto back = decode_request(bytes);
    REQUIRE(back);
    CHECK(back->port == "chair");
    CHECK(back->operation == "limits");
    CHECK(back->signature == "i:ad");
    CHECK(std::vector<std::byte>(back->arguments.begin(), back->arguments.end()) == arguments);
    CHECK((back->arguments.data() - bytes.data()) % 8 == 0);
}

TEST_CASE("a request with ids is found by them, with its arguments in place") {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    RequestHead("chair", "limits", "i:ad").put(out);
    out.put(std::uint64_t{77});
    const auto known = decode_known_request(bytes);
    REQUIRE(known);
    CHECK(known->id.port == port_id("chair"));
    CHECK(known->id.operation == operation_id("limits", "i:ad"));
    CHECK(wire::CdrReader(known->arguments).get<std::uint64_t>() == 77);
    const auto named = decode_request(bytes);
    REQUIRE(named);
    CHECK(named->operation == "limits");
    CHECK(named->arguments.data() == known->arguments.data());
    CHECK(operation_id("limits", "i:ad") != operation_id("limitsi", ":ad"));
    CHECK(operation_id("limits", "i:ad") != operation_id("limits", "i:d"));
}

TEST_CASE("whatever its ids and its length are, a request stays within its bytes") {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    RequestHead("chair", "limits", "i:ad").put(out);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        CHECK_FALSE(decode_known_request(std::span(bytes).first(size)));
    const auto head_bytes = static_cast<std::uint32_t>(bytes.size());
    for (const std::uint32_t claimed : {0U, 8U, 16U, 20U, 23U, head_bytes + 1, head_bytes + 8, ~0U}) {
        std::memcpy(bytes.data() + 16, &claimed, sizeof claimed);
        CHECK_FALSE(decode_known_request(bytes));
    }
    std::vector<std::byte> without_ids;
    wire::CdrWriter other(without_ids);
    encode(Request{"chair", "limits", "i:ad", {}}, other);
    CHECK_FALSE(decode_known_request(without_ids));
    CHECK(decode_request(without_ids));
}

TEST_CASE("bytes that are not a request are recognized") {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    encode(Request{"chair", "limits", ":ad", {}}, out);
    CHECK(decode_request(bytes));
    bytes.resize(10);
    CHECK_FALSE(decode_request(bytes));
    CHECK_FALSE(decode_request({}));
}

TEST_CASE("an operation that cannot cross does not affect the others") {
    const OperationTable table({{"add", "dd:d"}, {"paint", "{how}({deep}?{an M::How}):"}, {"odd", "z:"}});
    CHECK(table.find("add")->problem.empty());
    CHECK(table.find("paint")->problem == "argument 'how': field 'deep' is an M::How");
    CHECK_THAT(table.find("odd")->problem, Catch::Contains("'z'"));
    CHECK(table.find("other") == nullptr);
}

TEST_CASE("a method stands for the operation of its name or for an attribute") {
    const OperationTable table(
        {{"_get_speed", ":d"}, {"_set_speed", "d:"}, {"_get_Name", ":s"}, {"getPlace", ":i"}});
    for (const char* get : {"_get_speed", "get_speed", "getSpeed"})
        CHECK(table.find_for_method(get) == table.find("_get_speed"));
    CHECK(table.find_for_method("setSpeed") == table.find("_set_speed"));
    CHECK(table.find_for_method("getName") == table.find("_get_Name"));
    CHECK(table.find_for_method("getPlace") == table.find("getPlace"));
    for (const char* none : {"speed", "get", "getspeed", "set_", "setPlace", ""})
        CHECK(table.find_for_method(none) == nullptr);
}

TEST_CASE("an exception in a reply is read back unchanged, and damaged bytes have no id") {
    const ServiceException thrown{
        "IDL:M/TooFast:1.0", "too fast", {std::byte{1}, std::byte{2}, std::byte{3}}};
    const auto reply = make_exception_reply(thrown);
    CHECK(reply.status == CallStatus::user_exception);
    const auto back = decode_service_exception(reply.bytes);
    CHECK((back.id == thrown.id && back.text == thrown.text && back.fields == thrown.fields));
    for (std::size_t size = 0; size < 30; ++size)
        CHECK(decode_service_exception(std::span(reply.bytes).first(size)).id.empty());
}

TEST_CASE("settings of missing ports and settings of the other side are reported") {
    PortTable table;
    table.components = {{"Arm0", "Arm"}};
    table.ports = {{PortKind::data_in, "goal", "IDL:RTC/TimedDouble:1.0", "(uu)d", "", {}},
                   {PortKind::data_out, "state", "IDL:RTC/TimedDouble:1.0", "(uu)d", "", {}}};
    constexpr PortSetting all[] = {wait_ms_setting, deadline_ms_setting, {"gain", "data port", has_data}};
    const PortSettings of_owner{"parameter", "Peer", true, all}, of_peer{"property", "Owner", false, all};
    using Lines = std::vector<std::string>;
    CHECK(find_settings_without_port({"deadline_ms.goal", "wait_ms.state", "gain.goal"}, table, of_owner)
              .empty());
    CHECK(find_settings_without_port({"deadline_ms.state", "wait_ms.goal", "gain.goal"}, table, of_peer)
              .empty());
    CHECK(find_settings_without_port({"wait_ms", "gains.gaol", "vendor.gaol"}, table, of_owner).empty());
    CHECK(find_settings_without_port({"deadline_ms.gaol"}, table, of_owner) ==
          Lines{"parameter 'deadline_ms.gaol': Arm0 has no data port 'gaol'; it has goal, state; it counts "
                "when the port is added"});
    CHECK(
        find_settings_without_port({"wait_ms.goal"}, table, of_owner) ==
        Lines{
            "parameter 'wait_ms.goal' has no effect here: it is a setting of the side that sends; give it to "
            "Peer"});
    CHECK(
        find_settings_without_port({"deadline_ms.goal"}, table, of_peer) ==
        Lines{
            "property 'deadline_ms.goal' has no effect here: it is a setting of the side that receives; give "
            "it to Owner"});
}
