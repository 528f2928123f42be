// SPDX-License-Identifier: Apache-2.0
#include "tests/host/opros/fixtures/Pose.h"
#include "tests/host/opros/runtime/recording_archive.hpp"

#include <catch2/catch.hpp>

TEST_CASE("an opros_any tells its type and gives its value as that type only") {
    opros_any any = std::string("text");
    CHECK(any.type() == "std::string");
    CHECK(any.holds<std::string>());
    CHECK(*opros_any_cast<std::string>(&any) == "text");
    CHECK(opros_any_cast<int>(&any) == nullptr);
    CHECK_THROWS_AS(opros_any_cast<int>(any), std::bad_cast);
    CHECK(opros_any().empty());
    CHECK(opros_any().type() == "void");
}

TEST_CASE("copies of an opros_any are independent") {
    opros_any first = std::vector<int>{1};
    opros_any second = first;
    opros_any_cast<std::vector<int>>(&second)->push_back(2);
    CHECK(opros_any_cast<std::vector<int>>(&first)->size() == 1);
    first = second;
    CHECK(opros_any_cast<std::vector<int>>(&first)->size() == 2);
    first = 3.5;
    CHECK(first.type() == "double");
}

TEST_CASE("an opros_any is encoded and decoded without knowing its type") {
    Pose pose;
    pose.frame = "tool";
    const opros_any source = pose;
    opros_any target = Pose();
    REQUIRE(source.serializable());
    BinaryPipe pipe;
    source.encode(pipe.out);
    target.decode(pipe.in);
    CHECK(opros_any_cast<Pose>(&target)->frame == "tool");
}

TEST_CASE("an opros_any of a type without serialization works, but cannot be archived") {
    struct Local {
        int n = 0;
    };
    opros_any any = Local();
    CHECK_FALSE(any.serializable());
    BinaryPipe pipe;
    CHECK_THROWS_AS(any.encode(pipe.out), opros::archive::archive_type_exception);
    CHECK(opros_any(any).holds<Local>());
}

TEST_CASE("setType gives opros_params a type, unless they have a value") {
    opros_params result;
    result.setType(static_cast<double*>(nullptr));
    CHECK(result.type() == "double");
    result.setType(static_cast<int*>(nullptr));
    CHECK(result.type() == "double");
    result = 2.5;
    CHECK(*opros_params_cast<double>(&result) == 2.5);
}
