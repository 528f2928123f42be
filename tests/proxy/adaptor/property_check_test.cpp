// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/property_check.hpp"

#include <catch2/catch.hpp>

using namespace tandem::adaptor;
using tandem::link::PortKind;
using tandem::link::PortTable;
using Lines = std::vector<std::string>;

namespace {
PortTable arm() {
    return {{{"Arm0", "Arm"}},
            {{PortKind::data_in, "goal", "IDL:RTC/TimedDouble:1.0", "(uu)d", "", {}},
             {PortKind::data_out, "state", "IDL:RTC/TimedDouble:1.0", "(uu)d", "", {}}}};
}
} // namespace

TEST_CASE("properties of AdaptorComp with an effect are not reported") {
    const Lines properties{"deadline_ms.state", "keep_last.goal", "wait_ms.goal", "deadline_ms",
                           "convert.goal"};
    CHECK(find_properties_without_port(properties, arm()).empty());
    CHECK(find_unknown_properties(properties).empty());
}

TEST_CASE("a property of the other side or of a port of another kind is reported") {
    CHECK(
        find_properties_without_port({"deadline_ms.goal"}, arm()) ==
        Lines{
            "property 'deadline_ms.goal' has no effect here: it is a setting of the side that receives; give "
            "it to InterceptorComp"});
    CHECK(find_properties_without_port({"names.goal"}, arm()) ==
          Lines{"property 'names.goal': Arm0 has no service port or EventInPort 'goal'; it has none"});
}

TEST_CASE("an unknown property is reported, except those that engines set") {
    const Lines unknown = find_unknown_properties(
        {"dedline_ms.goal", "wait", "opros.component.dir", "_opros_xx_internal", "lnk"});
    REQUIRE(unknown.size() == 2);
    CHECK(unknown[0] ==
          "property 'dedline_ms.goal' is not one of AdaptorComp's and has no effect; of a port it has names, "
          "operations, convert, keep_last, wait_ms, deadline_ms");
    CHECK(unknown[1].starts_with(
        "property 'lnk' is not one of AdaptorComp's and has no effect; it has link, wait, "));
}
