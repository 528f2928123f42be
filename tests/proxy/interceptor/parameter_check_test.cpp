// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/parameter_check.hpp"

#include <catch2/catch.hpp>

using tandem::interceptor::find_useless_parameters;
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

TEST_CASE("parameters of InterceptorComp with an effect, and those of its manager, are not reported") {
    CHECK(find_useless_parameters({"deadline_ms.goal", "keep_last.state", "wait_ms.state", "vendor",
                                   "conf.default.goal", "link", "rtc", "manage", "ring_kib", "strict",
                                   "wait_ms", "instance_name", "exec_cxt.periodic.rate"},
                                  arm())
              .empty());
}

TEST_CASE("a parameter of the other side is reported") {
    CHECK(
        find_useless_parameters({"wait_ms.goal"}, arm()) ==
        Lines{
            "parameter 'wait_ms.goal' has no effect here: it is a setting of the side that sends; give it to "
            "AdaptorComp"});
}

TEST_CASE("an unknown parameter of a port is reported, including one of AdaptorComp's") {
    for (const std::string name : {"dedline_ms.goal", "convert.goal"})
        CHECK(find_useless_parameters({name}, arm()) ==
              Lines{"parameter '" + name +
                    "' is not one of InterceptorComp's and has no effect; of a port it has keep_last, "
                    "wait_ms and deadline_ms"});
}

TEST_CASE("an unknown parameter of InterceptorComp is reported with the known ones") {
    for (const std::string name : {"lnk", "strickt", "share", "wait", "call_timeout_ms"})
        CHECK(find_useless_parameters({name}, arm()) ==
              Lines{"parameter '" + name +
                    "' is not one of InterceptorComp's and has no effect; it has link, rtc, manage, "
                    "call_timeout, ring_kib, large_kib, segment_mib, group, strict, keep_last, wait_ms, "
                    "deadline_ms"});
}

TEST_CASE("an unknown parameter of an unknown port is reported") {
    CHECK(
        find_useless_parameters({"wait_sm.gaol"}, arm()) ==
        Lines{"parameter 'wait_sm.gaol' is not one of InterceptorComp's and has no effect; of a port it has "
              "keep_last, wait_ms and deadline_ms"});
}
