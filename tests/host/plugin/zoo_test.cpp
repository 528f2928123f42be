// SPDX-License-Identifier: Apache-2.0
// Probes each bad library of the zoo with the program of either model: the result is one line that says why it is
// refused, and this process is not affected.
#include "host/plugin/error.hpp"
#include "host/plugin/probe.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace {

struct BadLibrary {
    const char* name;
    std::vector<std::string> reason; ///< parts of the line; INIT is the function of the model at hand
    bool hangs = false;
};

const std::vector<BadLibrary> both_models{
    {"static_constructor_crashes", {" in its static constructors"}},
    {"static_constructor_aborts", {" in its static constructors", ": for this robot"}},
    {"static_constructor_throws", {" in its static constructors", "no device"}},
    {"static_constructor_hangs", {"did not return from its static constructors within 1 s"}, true},
    {"static_constructor_exits", {"ended the process in its static constructors with exit code 0"}},
    {"entry_throws", {"INIT", " threw an exception: no camera at port 3"}},
    {"entry_throws_a_number", {"INIT", " threw an exception of unknown type"}},
    {"entry_throws_its_own_type", {"INIT", " threw an exception: the arm is missing"}},
    {"entry_hangs", {"did not return from INIT within 1 s"}, true},
    {"entry_hangs_with_a_child", {"did not return from INIT within 1 s"}, true},
    {"entry_crashes", {" in INIT"}},
    {"entry_aborts", {" in INIT", "calibrated"}},
    {"entry_overflows_the_stack", {" in INIT"}},
    {"entry_exits", {"ended the process in INIT with exit code 3: usage: component DEVICE"}},
    {"entry_is_no_function", {" in INIT"}},
    {"library_missing", {"cannot be loaded", "libzoo_another_library.so"}},
};
const std::vector<BadLibrary> opros_only{
    {"getcomponent_returns_null", {"getComponent()", "returned NULL"}},
    {"destructor_crashes", {" in releaseComponent()"}},
    {"static_destructor_crashes", {" in its static destructors"}},
    {"no_entry", {"does not export getComponent"}},
    {"symbol_missing", {"cannot be loaded", "nobody_defines_this"}},
};
const std::vector<BadLibrary> rtm_only{
    {"rtc_constructor_throws", {"component type Thrower cannot be created: no gripper"}},
    {"rtc_factory_returns_null", {"component type Nothing cannot be created", "NULL"}},
    {"rtc_factory_hangs", {"did not return from the constructor of Waiter within 1 s"}, true},
    {"rtc_destructor_crashes", {" in the destructor of Fragile"}},
    {"rtc_factory_hangs_after_a_destructor",
     {"did not return from the constructor of Waiter within 1 s"},
     true},
    {"no_entry", {"does not export no_entryInit"}},
    {"symbol_missing",
     {"ended the process in INIT with exit code 127", "undefined symbol: ", "nobody_defines_this"}},
};

std::string refusal(const BadLibrary& bad, const std::string& model) {
    const bool rtm = model == "rtm";
    const std::string init = std::string(bad.name) + "Init";
    tandem::plugin::ProbeOptions options{rtm ? RTM_HOST : OPROS_HOST,
                                         std::chrono::seconds(bad.hangs ? 1 : 60)};
    const std::string file = ZOO "/" + model + "/" + bad.name + ".so";
    try {
        tandem::plugin::run_probe(options, "load-" + model, file,
                                  rtm ? std::vector<std::string>{init, "250"} : std::vector<std::string>{});
    } catch (const tandem::plugin::Error& error) {
        return error.what();
    }
    return "it was accepted";
}

void check(const BadLibrary& bad, const std::string& model) {
    const std::string text = refusal(bad, model);
    INFO(text);
    CHECK(text.find(bad.name) != std::string::npos);
    CHECK(text.find('\n') == std::string::npos);
    CHECK(text.size() < 1000);
    for (std::string part : bad.reason) {
        const std::string entry = model == "rtm" ? std::string(bad.name) + "Init()" : "getComponent()";
        if (const auto at = part.find("INIT"); at != std::string::npos) part.replace(at, 4, entry);
        CHECK_THAT(text, Catch::Contains(part));
    }
}

} // namespace

TEST_CASE("a bad OPRoS component is refused in one line that says what it did and where") {
    const auto all = GENERATE(both_models, opros_only);
    for (const BadLibrary& bad : all) check(bad, "opros");
}

TEST_CASE("a bad RTC module is refused in one line that says what it did and where") {
    const auto all = GENERATE(both_models, rtm_only);
    for (const BadLibrary& bad : all) check(bad, "rtm");
}

TEST_CASE("a good plugin of either model passes its probe") {
    CHECK_NOTHROW(
        tandem::plugin::run_probe({OPROS_HOST, std::chrono::seconds(60)}, "load-opros", OPROS_PLUGIN));
    CHECK_NOTHROW(tandem::plugin::run_probe({RTM_HOST, std::chrono::seconds(60)}, "load-rtm", RTM_PLUGIN,
                                            {"HWCompInit", "60000"}));
}
